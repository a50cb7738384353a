// A step of FluidSimulation: which stages run, those that are of no method in particular, and what becomes of a step
// that fails.

#include <algorithm>
#include <cmath>
#include <sstream>

#include "fluid_simulation.h"
#include "move_check.h"
#include "sluice/core/stage_times.h"

namespace sluice::sim {

namespace {

// After a step had to be taken back, its length grows again by this factor a step.
constexpr double kRecoveryGrowth = 1.25;

struct Count {
  std::uint64_t value = 0;
  Count& operator+=(const Count& other) {
    value += other.value;
    return *this;
  }
};

/// What the move holds back.
struct Held {
  Count particles;
  BodySums momenta;
  Held& operator+=(const Held& other) {
    particles += other.particles;
    momenta += other.momenta;
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

struct Squares {
  double sum = 0;
  Squares& operator+=(const Squares& other) {
    sum += other.sum;
    return *this;
  }
};

/// √(p/ρ0) with the root mean square of the last step's pressures: the speed of the waves that they carry, √(gH) in a
/// pool. How pressure pushes depends on where particles are, which a step takes as it was at its beginning: in steps in
/// which these waves cross more than about half a spacing, columns at rest were seen to burst.
double pressureSpeed(const ParticleState& state, double lastSeconds, const Team& team) {
  if (lastSeconds <= 0 || state.size() == 0) return 0;
  const auto squares = team.sumOverChunks<Squares>(state.size(), [&](const Chunk& chunk) {
    Squares part;
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      const auto kappa = static_cast<double>(state.densityImpulse[i]);
      part.sum += kappa * kappa;
    }
    return part;
  });
  return std::sqrt(std::sqrt(squares.sum / static_cast<double>(state.size())) / lastSeconds);
}

/// Waves shorten a step no further than to this share. What is left of an error of density costs a pressure that grows
/// as steps get shorter, which would shorten them on and on.
constexpr double kLeastWaveShare = 0.2;

std::string reasonToHalt(double time, double shortest, const std::string& trouble) {
  std::ostringstream message;
  message << "the simulation stopped at " << time << " s: a step would have to be shorter than "
          << "simulation.time_step.min_seconds, " << shortest << " s: " << trouble;
  return message.str();
}

}  // namespace

TimeStepInputs FluidSimulation::timeStepInputs() const {
  const double tension = settings_.has_surface_tension() ? settings_.surface_tension().tension() : 0;
  return {.spacing = discretisation_.spacing,
          .support = discretisation_.support,
          .maxSpeed = std::max(maxSpeed_, movingBodies_.largestSpeed(time_, settings_.time_step().max_seconds())),
          .acceleration = std::max(largestAcceleration() + touch_.largestAcceleration(time_), pressureAcceleration_),
          .viscosity = discretisation_.viscosityScale * mixture_.largestViscosity(),
          .kinematicTension = tension / mixture_.lightest(),
          .kinematicAdhesion = std::max(settings_.wall_adhesion(), bodies_.largestAdhesion()) / mixture_.lightest(),
          .speedOfSound = solver_->speedOfSound(),
          .courant = settings_.wcsph().courant(),
          .viscosityChoice = viscosityChoiceOf(settings_),
          .recovery = recoverySeconds_};
}

TimeStepChoice FluidSimulation::chooseLength() const {
  TimeStepInputs inputs = timeStepInputs();
  TimeStepChoice choice = chooseTimeStep(settings_.time_step(), inputs);
  // Where pressure acts by sound or by moving particles, steps are bounded otherwise or by nothing; where nothing
  // bounds the fluid, no pressure is the right one.
  const bool solvesForPressure = inputs.speedOfSound == 0 && !solver_->movesParticles() && !container_.periodic;
  const double waves = solvesForPressure ? pressureSpeed(state_, lastStepSeconds_, team_) : 0;
  if (waves > inputs.maxSpeed) {
    inputs.maxSpeed = waves;
    const TimeStepChoice shorter = chooseTimeStep(settings_.time_step(), inputs);
    if (shorter.seconds < choice.seconds) {
      const double least = kLeastWaveShare * choice.seconds;
      choice = shorter;
      choice.seconds = std::max(choice.seconds, least);
      if (choice.limit == "cfl") choice.limit = "pressure";
    }
  }
  const double forced = options_.experiment ? options_.experiment->forcedStep : 0;
  if (forced > 0) {
    choice.seconds = std::min(forced, recoverySeconds_);
    choice.limit = choice.seconds < forced ? "recovery" : "experiment";
  }
  return choice;
}

StepTraits FluidSimulation::traits(const TimeStepChoice& length) const {
  return {.particles = state_.size(),
          .boundaryInReach = boundaryInReach_,
          // Particles that come or go change the pairs.
          .freeFlight = !boundaryInReach_ && !bodiesInReach_ && !population_.changes() && !hasForceField() &&
                        !touch_.isActive(time_) && !container_.periodic &&
                        freeFlight_.covers(state_.velocity, length.seconds, team_),
          .bodiesMove = movingBodies_.anyMoves(),
          .bodiesRub = movingBodies_.anyRubs(),
          .bodiesInReach = bodiesInReach_,
          .standingAdhere = bodies_.anyStandingAdheres(),
          .movingAdhere = movingBodies_.anyAdheres(),
          .forceField = hasForceField(),
          .touched = touch_.isActive(time_),
          .implicitViscosity = length.implicitViscosity,
          .emitting = population_.emitting(time_)};
}

StepPlan FluidSimulation::planFor(const TimeStepChoice& length) const {
  const StepTraits present = traits(length);
  if (!options_.keepInertStages) return planStep(settings_, present);
  // A plan for a scene where every stage has something to do; it runs with this scene's own values.
  v1::Simulation busy = settings_;
  busy.mutable_gravity()->set_y(-1);
  busy.mutable_fluids(0)->set_viscosity(1);
  busy.set_wall_adhesion(1);
  if (busy.has_surface_tension()) busy.mutable_surface_tension()->set_tension(1);
  if (busy.has_micropolar()) busy.mutable_micropolar()->set_transfer(1);
  return planStep(busy, {.particles = present.particles,
                         .bodiesMove = present.bodiesMove,
                         .bodiesRub = present.bodiesRub,
                         .bodiesInReach = present.bodiesInReach,
                         .forceField = present.forceField,
                         .touched = true,
                         .implicitViscosity = present.implicitViscosity,
                         .emitting = present.emitting});
}

bool FluidSimulation::advance() {
  const core::StepStatistics before = statistics_;
  while (halted_.empty()) {
    if (tryStep()) return true;
    statistics_ = before;
  }
  return false;
}

StepContext FluidSimulation::beginStep() {
  statistics_.stages.clear();
  statistics_.densityIterations = statistics_.divergenceIterations = statistics_.viscosityIterations = 0;
  keepsBeginning_ = solver_->movesParticles() || !sortedInStep_;
  sortedInStep_ = false;
  if (keepsBeginning_) {
    beginning_ = state_;
    populationBefore_ = population_.state();
  } else if (beginning_.size() > 0) {
    beginning_ = {};  // Most scenes need it in their first step alone.
  }
  findBoundaryInReach();
  length_ = chooseLength();
  shortenToStop();
  bodiesBefore_ = movingBodies_.state();
  movingBodies_.drive(time_, stepSeconds_);
  return {.discretisation = discretisation_,
          .container = container_,
          .boundary = boundary_,
          .walls = walls_,
          .mixture = mixture_,
          .team = team_,
          .grid = grid_,
          .lists = lists_,
          .state = state_,
          .statistics = statistics_,
          .bodies = movingBodies_.empty() ? nullptr : &bodyStep_,
          .seconds = stepSeconds_,
          .lastSeconds = lastStepSeconds_,
          .maxCompression = settings_.time_step().max_compression() / 100,
          .boundaryInReach = boundaryInReach_,
          .bodiesInReach = bodiesInReach_,
          .trouble = {}};
}

void FluidSimulation::shortenToStop() {
  stepSeconds_ = length_.seconds;
  const double left = stop_ - time_;
  reachesStop_ = left > 0 && left <= stepSeconds_;
  if (reachesStop_) {
    stepSeconds_ = left;
  } else if (left > 0 && left < 2 * stepSeconds_) {
    // Two steps alike instead of a long one and what it leaves over, which may be next to nothing.
    stepSeconds_ = 0.5 * left;
  }
  if (stepSeconds_ < length_.seconds) length_.limit = "frame";
}

bool FluidSimulation::tryStep() {
  StepContext step = beginStep();
  const StepPlan plan = planFor(length_);
  for (const Stage stage : plan.stages) {
    run(stage, step);
    if (step.trouble.empty()) continue;
    takeBack();
    recoverySeconds_ = 0.5 * stepSeconds_;
    const double shortest = settings_.time_step().min_seconds();
    if (recoverySeconds_ < shortest) halted_ = reasonToHalt(time_, shortest, step.trouble);
    return false;
  }
  if (!plan.contains(Stage::Neighbours)) freeFlight_.advance(state_.velocity, step.seconds, team_);
  if (!plan.contains(Stage::MovingBoundary)) contacts_.clear();
  finish(step);
  followMomentum(plan, step.seconds);
  return true;
}

void FluidSimulation::finish(const StepContext& step) {
  time_ = endOfStep();
  touch_.expire(time_);
  lastStepSeconds_ = step.seconds;
  maxSpeed_ = step.maxSpeed;
  pressureAcceleration_ = step.pressureAcceleration;
  recoverySeconds_ *= kRecoveryGrowth;
  ++statistics_.steps;
  statistics_.timeStepSeconds = step.seconds;
  statistics_.timeStepLimit = length_.limit;
  statistics_.maxSpeed = maxSpeed_;
}

void FluidSimulation::run(Stage stage, StepContext& step) {
  const core::StageTimer timer(statistics_.stages, stageName(stage));
  switch (stage) {
    case Stage::TimeStep:
      return acceptLength(step);
    case Stage::SurfaceTension:
      return surfaceTension_->apply(settings_.surface_tension(), step);
    case Stage::Adhesion:
      return adhesion_.apply(settings_.wall_adhesion(), bodies_, step);
    case Stage::Micropolar:
      return micropolar_.apply(settings_.micropolar(), step);
    case Stage::Viscosity:
      return explicitViscosity_.apply(step);
    case Stage::ImplicitViscosity:
      return implicitViscosity_.apply(settings_.has_implicit_viscosity() ? settings_.implicit_viscosity()
                                                                         : settings_.automatic_viscosity().implicit(),
                                      step);
    case Stage::BodyFriction:
      return contacts_.rub(movingBodies_, mixture_, discretisation_.volume, step.seconds, state_.fluid, state_.velocity,
                           team_);
    case Stage::Gravity:
      return applyGravity(step);
    case Stage::Touch:
      return applyTouch(step);
    case Stage::RigidBodies:
      return movingBodies_.advance(time_, step.seconds);
    case Stage::Move:
      return move(step);
    case Stage::Drains:
      return population_.drain(state_, team_);
    case Stage::Emitters:
      return emit(step);
    case Stage::Sort:
      return sort();
    case Stage::Neighbours:
      return findNeighbours();
    case Stage::Boundary:
      return lists_.addBoundary(boundary_, wallAnswer(), grid_, state_.position, team_);
    case Stage::MovingBoundary:
      return updateMovingBoundary(step);
    case Stage::DensityError:
      return measureCompression();
    case Stage::DivergenceSolve:
    case Stage::DensitySolve:
    case Stage::EquationOfState:
    case Stage::PositionSolve:
    case Stage::Factors:
      return solver_->run(stage, step);
  }
}

void FluidSimulation::acceptLength(StepContext& step) const {
  // What a stop leaves may be shorter.
  if (length_.seconds >= settings_.time_step().min_seconds()) return;
  std::ostringstream text;
  text << "the bound \"" << length_.limit << "\" allows " << length_.seconds << " s";
  step.trouble = text.str();
}

void FluidSimulation::move(StepContext& step) {
  step.maxSpeed = checkedMaxSpeed(step);
  if (!step.trouble.empty()) return;
  const auto seconds = static_cast<float>(step.seconds);
  const auto held = team_.sumOverChunks<Held>(state_.size(), [&](const Chunk& chunk) {
    Held part;
    BodyPush push;
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      if (step.bodies != nullptr) push.particleMass = discretisation_.volume * mixture_.restDensityOf(state_.fluid, i);
      Float4& x = state_.position[i];
      Float4& v = state_.velocity[i];
      const Float4 to{x.x + seconds * v.x, x.y + seconds * v.y, x.z + seconds * v.z, 0};
      part.particles.value += walls_.move(x, v, to, push) ? 1 : 0;
    }
    part.momenta = std::move(push.momenta);
    return part;
  });
  wallContacts_ += held.particles.value;
  movingBodies_.push(held.momenta);
  movingBodies_.settle();
}

void FluidSimulation::emit(StepContext& step) {
  const v1::Vec3& g = settings_.gravity();
  const Population::Moment moment{endOfStep(), {g.x(), g.y(), g.z()}, mostParticles()};
  step.maxSpeed = std::max(step.maxSpeed, population_.emit(state_, moment, team_));
}

void FluidSimulation::sort() {
  sortedInStep_ = true;
  std::swap(state_, previous_);
  grid_.sort(previous_.position, team_);
  state_.resizeLike(previous_);
  team_.forEachChunk(state_.size(), [&](const Chunk& chunk) { state_.gather(previous_, grid_.order(), chunk); });
}

void FluidSimulation::findNeighbours() {
  lists_.find(grid_, state_.position, team_);
  const auto pairs = team_.sumOverChunks<Count>(state_.size(), [&](const Chunk& chunk) {
    Count part;
    for (std::size_t i = chunk.first; i < chunk.last; ++i) part.value += lists_.neighbours()[i];
    return part;
  });
  if (pairs.value > 0) {
    freeFlight_.noteNeighbours();
  } else {
    freeFlight_.noteNone(grid_, state_.position, discretisation_.support, team_);
  }
}

void FluidSimulation::takeBack() {
  if (!movingBodies_.empty()) movingBodies_.restore(bodiesBefore_);
  if (keepsBeginning_) {
    state_ = beginning_;
    population_.takeBack(populationBefore_);
    if (!sortedInStep_) return;
    sort();
    lists_.find(grid_, state_.position, team_);
    lists_.addBoundary(boundary_, wallAnswer(), grid_, state_.position, team_);
    if (movingBodies_.empty()) return;
    movingBoundary_.update(movingBodies_, boundary_, team_);
    contacts_.find(movingBoundary_, movingBodies_, grid_, state_.position, lists_, team_);
    return;
  }
  // The step failed before it moved anything: positions, pairs and densities still are those of the last good state.
  team_.forEachChunk(state_.size(), [&](const Chunk& chunk) { state_.gather(previous_, grid_.order(), chunk); });
}

void FluidSimulation::measureCompression() {
  // The density that the solver works with, where it is not that of the pairs.
  const bool own = !state_.compression.empty();
  const auto compression = team_.sumOverChunks<CompressionSum>(state_.size(), [&](const Chunk& chunk) {
    CompressionSum part;
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      const float compressed = std::max(own ? state_.compression[i] : lists_.density()[i] - 1.0F, 0.0F);
      part.sum += static_cast<double>(compressed);
      part.largest = std::max(part.largest, compressed);
    }
    return part;
  });
  statistics_.meanDensityError = state_.size() > 0 ? compression.sum / static_cast<double>(state_.size()) : 0;
  statistics_.maxDensityError = static_cast<double>(compression.largest);
}

}  // namespace sluice::sim
