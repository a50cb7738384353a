#include "fluid_simulation.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <thread>

#include "lattice.h"
#include "memory_budget.h"
#include "sluice/core/check.h"
#include "sluice/core/input_error.h"

namespace sluice::sim {

namespace {

int threadCount(int asked) {
  return asked > 0 ? asked : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

KernelKind kernelOf(const v1::Simulation&) { return KernelKind::CubicSpline; }

double supportOf(const v1::Simulation& settings) {
  return settings.cubic_spline().support_in_spacings() * settings.particle_spacing();
}

/// Cells per axis and in all that the particles of a box are sorted into: no more than a few per particle.
CellGeometry cellsOf(const Container& container, double support, double particles) {
  constexpr double kCellsPerParticle = 8;
  constexpr double kFewCells = 1 << 16;
  return CellGeometry::covering(container.size, support,
                                static_cast<std::uint64_t>(std::max(kFewCells, kCellsPerParticle * particles)));
}

double checkedBoundaryCount(const v1::Simulation& settings, const Container& container) {
  const double count = BoxBoundary::expectedCount(container.size, settings.particle_spacing());
  const double limit = 0.5 * static_cast<double>(availableMemory()) / static_cast<double>(kBytesPerBoundaryParticle);
  if (count > std::min(limit, 4e9)) {
    std::ostringstream problem;
    problem << "the container's faces would need " << count << " boundary particles; this machine's free memory allows "
            << std::min(limit, 4e9) << ": use a smaller container or a larger particle_spacing";
    throw core::InputError("", "simulation.container", problem.str());
  }
  return count;
}

ParticleState checkedInitialState(const v1::Simulation& settings, const Container& container) {
  // Particles are numbered with 32 bits, of which the pair loops use the sign.
  constexpr std::uint64_t kMostParticles = (std::uint64_t{1} << 31) - 1;
  // 0.8: the rest of the program needs memory too.
  const auto affordable = static_cast<std::uint64_t>(0.8 * static_cast<double>(availableMemory())) / kBytesPerParticle;
  return initialState(settings, container, std::min(affordable, kMostParticles));
}

}  // namespace

FluidSimulation::FluidSimulation(const v1::Simulation& settings, const SimulationOptions& options)
    : FluidSimulation(settings, options, threadCount(options.threads), containerOf(settings), kernelOf(settings),
                      supportOf(settings),
                      particleVolume(kernelOf(settings), settings.particle_spacing(), supportOf(settings))) {}

FluidSimulation::FluidSimulation(const v1::Simulation& settings, const SimulationOptions& options, int threads,
                                 const Container& container, KernelKind kernel, double support, double volume)
    : settings_(settings),
      options_(options),
      team_(threads),
      mixture_(settings),
      container_(container),
      support_(support),
      volume_(volume),
      boundary_(container.size, settings.particle_spacing(), support, kernel, volume,
                cellsOf(container, support, checkedBoundaryCount(settings, container)), team_),
      grid_(boundary_.grid().geometry()),
      lists_(options.loops != nullptr ? *options.loops : bestPairLoops(), PairScale(kernel, support, volume)) {
  reset();
  checkOverlaps();
}

void FluidSimulation::reset() {
  state_ = checkedInitialState(settings_, container_);
  previous_.resize(state_.size());
  previous_.fluid.resize(state_.fluid.size());
  statistics_ = {};
  time_ = lastStepSeconds_ = 0;
  length_ = {};
  recoverySeconds_ = std::numeric_limits<double>::infinity();
  wallContacts_ = 0;
  halted_.clear();
  maxSpeed_ = 0;
  for (const Float4& v : state_.velocity) {
    maxSpeed_ = std::max(maxSpeed_, std::sqrt(static_cast<double>(v.x * v.x + v.y * v.y + v.z * v.z)));
  }
  statistics_.maxSpeed = maxSpeed_;
  boundaryInReach_ = true;
  for (const Stage stage : {Stage::Sort, Stage::Neighbours, Stage::Boundary, Stage::Factors}) run(stage);
  statistics_.stages.clear();
  findBoundaryInReach();
}

void FluidSimulation::checkOverlaps() const {
  // Touching blocks may stand a little closer than the lattice; half-way into each other's spacing they would burst.
  constexpr double kClosest = 0.75;
  const double closest = kClosest * settings_.particle_spacing();
  for (std::size_t i = 0; i < state_.size(); ++i) {
    const CellGrid::Neighbourhood around = grid_.around(grid_.cellOfSorted()[i]);
    for (int r = 0; r < around.count; ++r) {
      for (std::uint32_t j = around.ranges[r].first; j < std::min<std::uint32_t>(around.ranges[r].last, i); ++j) {
        const double dx = state_.position[i].x - state_.position[j].x;
        const double dy = state_.position[i].y - state_.position[j].y;
        const double dz = state_.position[i].z - state_.position[j].z;
        const double distance = std::sqrt(dx * dx + dy * dy + dz * dz);
        if (distance >= closest) continue;
        const auto [earlier, later] = std::minmax(state_.id[i], state_.id[j]);
        std::ostringstream problem;
        problem << "the block overlaps " << blockOf(settings_, earlier) << ": two particles are " << distance
                << " m apart, at least " << closest << " m is allowed";
        throw core::InputError("", blockOf(settings_, later) + ".first_particle", problem.str());
      }
    }
  }
}

std::unique_ptr<core::ParticleSnapshot> FluidSimulation::snapshot() const {
  auto snapshot = std::make_unique<core::ParticleSnapshot>();
  snapshot->time = time_;
  snapshot->spacing = settings_.particle_spacing();
  snapshot->restDensity = mixture_.restDensities().front();
  if (mixture_.several()) snapshot->restDensities = mixture_.restDensities();
  snapshot->positions.resize(state_.size());
  snapshot->velocities.resize(state_.size());
  snapshot->densities.resize(state_.size());
  snapshot->ids = state_.id;
  snapshot->pressures.resize(state_.size());
  // Every particle is there from the start.
  snapshot->ages.assign(state_.size(), static_cast<float>(time_));
  snapshot->fluids = state_.fluid;
  snapshot->supportRadius = support_;
  snapshot->neighbours.resize(state_.size());
  const std::vector<float> restDensity(mixture_.restDensities().begin(), mixture_.restDensities().end());
  // κ = p·dt/ρ_max: u = v − dt/ρ·∇p, see Mixture. Of the density solve, which is the one that carries gravity.
  const float pressureOfImpulse =
      lastStepSeconds_ > 0 ? static_cast<float>(mixture_.heaviest() / lastStepSeconds_) : 0.0F;
  const Eigen::Vector3f origin(static_cast<float>(container_.origin[0]), static_cast<float>(container_.origin[1]),
                               static_cast<float>(container_.origin[2]));
  team_.forEachChunk(state_.size(), [&](const Chunk& chunk) {
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      const Float4& x = state_.position[i];
      const Float4& v = state_.velocity[i];
      snapshot->positions[i] = origin + Eigen::Vector3f(x.x, x.y, x.z);
      snapshot->velocities[i] = {v.x, v.y, v.z};
      snapshot->densities[i] = restDensity[state_.fluid.empty() ? 0 : state_.fluid[i]] * lists_.density()[i];
      snapshot->pressures[i] = pressureOfImpulse * state_.densityImpulse[i];
    }
    lists_.countFluidNeighbours(chunk, snapshot->neighbours);
  });
  snapshot->bounds = core::boundsOf(snapshot->positions);
  snapshot->statistics = statistics_;
  return snapshot;
}

void FluidSimulation::update(const v1::Scene& scene) {
  if (!scene.has_simulation()) throw core::InputError("", "simulation", "the scene has no simulation to update");
  const v1::Simulation& next = scene.simulation();
  if (next.fluids_size() != settings_.fluids_size()) {
    throw core::InputError("", "simulation.fluids", "the number of fluids cannot change while the simulation runs");
  }
  if (next.time_step().min_seconds() > next.time_step().max_seconds()) {
    throw core::InputError("", "simulation.time_step.min_seconds", "must not be more than max_seconds");
  }
  *settings_.mutable_gravity() = next.gravity();
  *settings_.mutable_dfsph() = next.dfsph();
  *settings_.mutable_time_step() = next.time_step();
  for (int f = 0; f < next.fluids_size(); ++f) {
    settings_.mutable_fluids(f)->set_name(next.fluids(f).name());
    settings_.mutable_fluids(f)->set_viscosity(next.fluids(f).viscosity());
  }
  mixture_.setViscosities(settings_);
  // What stopped it (a smallest time step, too few iterations) may just have been changed.
  halted_.clear();
  recoverySeconds_ = std::numeric_limits<double>::infinity();
}

core::Plan FluidSimulation::plan() const {
  core::Plan plan = describe(currentPlan());
  const auto add = [&](std::string_view name, std::uint64_t bytes) {
    plan.buffers.push_back({std::string(name), bytes});
  };
  const std::uint64_t particles = state_.size();
  add("state, twice", 2 * particles * (2 * sizeof(Float4) + 2 * sizeof(float) + sizeof(std::uint32_t)) +
                          (state_.fluid.size() + previous_.fluid.size()) * sizeof(std::uint8_t));
  add("pairs and sums", lists_.bytes());
  add("pressure solve", solver_.bytes());
  add("factors", (factor_.size() + divergenceFactor_.size()) * sizeof(float));
  add("forces", scratch_.size() * sizeof(Float4));
  add("cells", (grid_.starts().size() + 3 * particles) * sizeof(std::uint32_t));
  add("boundary", boundary_.size() * (sizeof(Float4) + sizeof(float)) +
                      (boundary_.grid().starts().size() + 3 * boundary_.size()) * sizeof(std::uint32_t));
  return plan;
}

}  // namespace sluice::sim
