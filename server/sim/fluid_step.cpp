// The stages of a step of FluidSimulation, and what becomes of a step that fails.

#include <algorithm>
#include <cmath>
#include <sstream>

#include "fluid_simulation.h"
#include "sluice/core/stage_times.h"

namespace sluice::sim {

namespace {

// A step in which a particle would cross more than this many spacings is taken back: it could jump through the one
// layer of boundary particles. The CFL number may be up to 1.
constexpr double kLargestMove = 1.5;

// A density solve that has used up its iterations is accepted while the mean compression left is below this.
constexpr double kSaneCompression = 0.01;

// How close to a face a particle may come, in spacings, before it is held there. Pressure keeps particles about one
// spacing away; only a fast one that flies alone gets near, because a lone particle is not compressed by its speed.
constexpr float kWallClearance = 0.5F;

// After a step had to be taken back, its length grows again by this factor a step.
constexpr double kRecoveryGrowth = 1.25;

// Share of the last step's impulses that a solve starts from.
constexpr double kDensityWarmStart = 0.5;
constexpr double kDivergenceWarmStart = 0.5;

// Fluids further apart in rest density than this are worth a word where a density solve fails.
constexpr double kDemandingRatio = 10;

// Fewer neighbours than this mark a free surface in three dimensions, where divergence is no sign of compression
// [BK17].
constexpr std::uint16_t kFullNeighbourhood = 20;

struct MoveCheck {
  double largestSquare = 0;
  bool finite = true;

  MoveCheck& operator+=(const MoveCheck& other) {
    largestSquare = std::max(largestSquare, other.largestSquare);
    finite = finite && other.finite;
    return *this;
  }
};

struct Count {
  std::uint64_t value = 0;
  Count& operator+=(const Count& other) {
    value += other.value;
    return *this;
  }
};

struct CompressionSum {
  double sum = 0;
  float largest = 0;

  CompressionSum& operator+=(const CompressionSum& other) {
    sum += other.sum;
    largest = std::max(largest, other.largest);
    return *this;
  }
};

double squaredNorm(const Float4& v) {
  return static_cast<double>(v.x) * v.x + static_cast<double>(v.y) * v.y + static_cast<double>(v.z) * v.z;
}

double norm(const v1::Vec3& v) { return std::sqrt(v.x() * v.x() + v.y() * v.y() + v.z() * v.z()); }

/// Holds one coordinate inside [low, high]; returns whether it had to.
bool hold(float& position, float& velocity, float low, float high) {
  if (position >= low && position <= high) return false;
  const bool below = position < low;
  position = below ? low : high;
  if (below == (velocity < 0)) velocity = 0;
  return true;
}

}  // namespace

StepPlan FluidSimulation::currentPlan() const {
  if (!options_.keepInertStages) return planStep(settings_, {state_.size(), boundaryInReach_});
  // A plan for a scene where every stage has something to do; it runs with this scene's own values.
  v1::Simulation busy = settings_;
  busy.mutable_gravity()->set_y(-1);
  busy.mutable_fluids(0)->set_viscosity(1);
  return planStep(busy, {state_.size(), true});
}

bool FluidSimulation::advance() {
  const core::StepStatistics before = statistics_;
  while (halted_.empty()) {
    if (tryStep()) return true;
    takeBack();
    statistics_ = before;
    recoverySeconds_ = 0.5 * length_.seconds;
    const double shortest = settings_.time_step().min_seconds();
    if (recoverySeconds_ >= shortest) continue;
    std::ostringstream message;
    message << "the simulation stopped at " << time_ << " s: a step would have to be shorter than "
            << "simulation.time_step.min_seconds, " << shortest << " s: " << trouble_;
    halted_ = message.str();
  }
  return false;
}

bool FluidSimulation::tryStep() {
  trouble_.clear();
  statistics_.stages.clear();
  findBoundaryInReach();
  const StepPlan plan = currentPlan();
  for (const Stage stage : plan.stages) {
    run(stage);
    if (!trouble_.empty()) return false;
  }
  time_ += length_.seconds;
  lastStepSeconds_ = length_.seconds;
  recoverySeconds_ *= kRecoveryGrowth;
  ++statistics_.steps;
  statistics_.timeStepSeconds = length_.seconds;
  statistics_.timeStepLimit = length_.limit;
  statistics_.maxSpeed = maxSpeed_;
  return true;
}

void FluidSimulation::run(Stage stage) {
  const core::StageTimer timer(statistics_.stages, stageName(stage));
  switch (stage) {
    case Stage::TimeStep:
      return chooseLength();
    case Stage::DivergenceSolve:
      return solveDivergence();
    case Stage::Viscosity:
      return applyViscosity();
    case Stage::Gravity:
      return applyGravity();
    case Stage::DensitySolve:
      return solveDensity();
    case Stage::Move:
      return move();
    case Stage::Sort:
      return sort();
    case Stage::Neighbours:
      return lists_.find(grid_, state_.position, team_);
    case Stage::Boundary:
      return lists_.addBoundary(boundary_, grid_, state_.position, team_);
    case Stage::Factors:
      return computeFactors();
  }
}

void FluidSimulation::chooseLength() {
  length_ =
      chooseTimeStep(settings_.time_step(), {settings_.particle_spacing(), support_, maxSpeed_,
                                             norm(settings_.gravity()), mixture_.largestViscosity(), recoverySeconds_});
  if (length_.seconds < settings_.time_step().min_seconds()) {
    std::ostringstream text;
    text << "the bound \"" << length_.limit << "\" allows " << length_.seconds << " s";
    trouble_ = text.str();
  }
}

void FluidSimulation::solveDivergence() {
  const v1::Dfsph& dfsph = settings_.dfsph();
  SolveGoal goal;
  goal.seconds = length_.seconds;
  goal.tolerance = dfsph.divergence_error() / 100;
  goal.maxIterations = dfsph.max_iterations();
  scaleImpulses(state_.divergenceImpulse, dfsph.warm_start() ? kDivergenceWarmStart : 0);
  const SolveOutcome outcome = solver_.run(goal, lists_, mixture_.mobility(state_.fluid), divergenceFactor_,
                                           state_.velocity, state_.divergenceImpulse, team_);
  statistics_.divergenceIterations = outcome.iterations;
}

void FluidSimulation::applyViscosity() {
  // a_i = 2(D+2) Σ_j ν_ij V_j (v_ij·x_ij) / (|x_ij|² + 0.01 H²) ∇W_ij with D = 3, Monaghan 1992 (the classical form,
  // which keeps linear and angular momentum); as ∇W_ij is parallel to x_ij, (v_ij·x_ij) ∇W_ij = (v_ij·∇W_ij) x_ij.
  // Walls are free of friction.
  const PairFriction friction = mixture_.friction(state_.fluid, length_.seconds);
  scratch_.resize(state_.size());
  team_.forEachChunk(state_.size(), [&](const Chunk& chunk) {
    lists_.loops().applyViscosity(lists_.chunk(chunk), lists_.scale(), friction, state_.position.data(),
                                  state_.velocity.data(), scratch_.data());
  });
  state_.velocity.swap(scratch_);
}

void FluidSimulation::applyGravity() {
  const auto change = [&](double g) { return static_cast<float>(g * length_.seconds); };
  const Float4 dv{change(settings_.gravity().x()), change(settings_.gravity().y()), change(settings_.gravity().z()), 0};
  team_.forEachChunk(state_.size(), [&](const Chunk& chunk) {
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      Float4& v = state_.velocity[i];
      v = {v.x + dv.x, v.y + dv.y, v.z + dv.z, 0};
    }
  });
}

void FluidSimulation::solveDensity() {
  const v1::Dfsph& dfsph = settings_.dfsph();
  SolveGoal goal;
  goal.density = &lists_.density();
  goal.seconds = length_.seconds;
  goal.tolerance = dfsph.density_error() / 100;
  goal.minIterations = 2;  // [BK17]: one iteration measures, but does not yet couple neighbours.
  goal.maxIterations = dfsph.max_iterations();
  // An impulse is pressure times time: the same pressure over a step of another length.
  const double ratio = lastStepSeconds_ > 0 ? length_.seconds / lastStepSeconds_ : 0;
  scaleImpulses(state_.densityImpulse, dfsph.warm_start() ? kDensityWarmStart * ratio : 0);
  const SolveOutcome outcome = solver_.run(goal, lists_, mixture_.mobility(state_.fluid), factor_, state_.velocity,
                                           state_.densityImpulse, team_);
  statistics_.densityIterations = outcome.iterations;

  const double sane = std::max(kSaneCompression, 10 * goal.tolerance);
  if (outcome.iterations == goal.maxIterations && outcome.meanError > sane) {
    std::ostringstream text;
    text << "the density solve left a mean compression of " << 100 * outcome.meanError << " % after "
         << outcome.iterations << " iterations";
    // Jacobi iteration moves pressure on slowly where a light fluid carries a heavy one.
    if (mixture_.densityRatio() > kDemandingRatio) {
      text << ", in fluids whose rest densities differ by a factor of " << mixture_.densityRatio()
           << " (more simulation.dfsph.max_iterations, or rest densities closer to each other, would help)";
    }
    trouble_ = text.str();
  }
}

void FluidSimulation::scaleImpulses(std::vector<float>& impulse, double scale) const {
  // An impulse that would push the lattice apart by more than a tenth of its spacing is no good guess.
  const double spacing = settings_.particle_spacing();
  const auto largest = static_cast<float>(0.1 * spacing * spacing / length_.seconds);
  const auto factor = static_cast<float>(scale);
  team_.forEachChunk(impulse.size(), [&](const Chunk& chunk) {
    for (std::size_t i = chunk.first; i < chunk.last; ++i) impulse[i] = std::min(impulse[i] * factor, largest);
  });
}

void FluidSimulation::move() {
  const auto check = team_.sumOverChunks<MoveCheck>(state_.size(), [&](const Chunk& chunk) {
    MoveCheck part;
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      const double square = squaredNorm(state_.velocity[i]);
      part.largestSquare = std::max(part.largestSquare, square);
      part.finite = part.finite && std::isfinite(square);
    }
    return part;
  });
  const double fastest = std::sqrt(check.largestSquare);
  const double spacings = fastest * length_.seconds / settings_.particle_spacing();
  if (!check.finite) {
    trouble_ = "velocities are no longer finite";
    return;
  }
  if (spacings > kLargestMove) {
    std::ostringstream text;
    text << "a particle would move by " << spacings << " particle spacings in one step";
    trouble_ = text.str();
    return;
  }

  const float clearance = kWallClearance * static_cast<float>(settings_.particle_spacing());
  const std::array<float, 3> high{static_cast<float>(container_.size[0]) - clearance,
                                  static_cast<float>(container_.size[1]) - clearance,
                                  static_cast<float>(container_.size[2]) - clearance};
  const auto seconds = static_cast<float>(length_.seconds);
  const auto held = team_.sumOverChunks<Count>(state_.size(), [&](const Chunk& chunk) {
    Count part;
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      Float4& x = state_.position[i];
      Float4& v = state_.velocity[i];
      x = {x.x + seconds * v.x, x.y + seconds * v.y, x.z + seconds * v.z, 0};
      const bool heldX = hold(x.x, v.x, clearance, high[0]);
      const bool heldY = hold(x.y, v.y, clearance, high[1]);
      const bool heldZ = hold(x.z, v.z, clearance, high[2]);
      if (heldX || heldY || heldZ) ++part.value;
    }
    return part;
  });
  wallContacts_ += held.value;
  maxSpeed_ = fastest;
}

void FluidSimulation::sort() {
  std::swap(state_, previous_);
  grid_.sort(previous_.position, team_);
  state_.resize(previous_.size());
  state_.fluid.resize(previous_.fluid.size());
  team_.forEachChunk(state_.size(), [&](const Chunk& chunk) {
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      const std::uint32_t from = grid_.order()[i];
      state_.position[i] = previous_.position[from];
      state_.velocity[i] = previous_.velocity[from];
      state_.densityImpulse[i] = previous_.densityImpulse[from];
      state_.divergenceImpulse[i] = previous_.divergenceImpulse[from];
      state_.id[i] = previous_.id[from];
    }
    if (!mixture_.several()) return;
    for (std::size_t i = chunk.first; i < chunk.last; ++i) state_.fluid[i] = previous_.fluid[grid_.order()[i]];
  });
}

void FluidSimulation::takeBack() {
  // A step fails before it moves anything: positions, pairs and densities still are those of the last good state.
  team_.forEachChunk(state_.size(), [&](const Chunk& chunk) {
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      const std::uint32_t from = grid_.order()[i];
      state_.velocity[i] = previous_.velocity[from];
      state_.densityImpulse[i] = previous_.densityImpulse[from];
      state_.divergenceImpulse[i] = previous_.divergenceImpulse[from];
    }
  });
}

void FluidSimulation::computeFactors() {
  factor_.resize(state_.size());
  divergenceFactor_.resize(state_.size());
  // Below this share of 1/H² there is no neighbour to push against.
  const float least = 1e-6F / static_cast<float>(support_ * support_);
  const Mobility mobility = mixture_.mobility(state_.fluid);
  const auto compression = team_.sumOverChunks<CompressionSum>(state_.size(), [&](const Chunk& chunk) {
    CompressionSum part;
    if (mobility.fluid != nullptr) lists_.loops().weighSquares(lists_.chunk(chunk), mobility, factor_.data());
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      const Float4& d = lists_.gradientSum()[i];
      const float own = d.x * d.x + d.y * d.y + d.z * d.z;
      const float denominator = mobility.fluid == nullptr ? own + lists_.gradientSquares()[i]  // 1/α_i [BK17]
                                                          : mobility.ofFluid[state_.fluid[i]] * own + factor_[i];
      factor_[i] = denominator > least ? 1 / denominator : 0;
      divergenceFactor_[i] = lists_.neighbours()[i] >= kFullNeighbourhood ? factor_[i] : 0;
      const float compressed = std::max(lists_.density()[i] - 1.0F, 0.0F);
      part.sum += static_cast<double>(compressed);
      part.largest = std::max(part.largest, compressed);
    }
    return part;
  });
  statistics_.meanDensityError = compression.sum / static_cast<double>(state_.size());
  statistics_.maxDensityError = static_cast<double>(compression.largest);
}

void FluidSimulation::findBoundaryInReach() {
  const double reach = support_ + kLargestMove * settings_.particle_spacing();
  const auto near = team_.sumOverChunks<Count>(state_.size(), [&](const Chunk& chunk) {
    Count part;
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      const Float4& x = state_.position[i];
      const auto nearFace = [&](double position, double size) { return position < reach || position > size - reach; };
      const auto& size = container_.size;
      part.value += nearFace(x.x, size[0]) || nearFace(x.y, size[1]) || nearFace(x.z, size[2]) ? 1 : 0;
    }
    return part;
  });
  boundaryInReach_ = near.value > 0;
}

}  // namespace sluice::sim
