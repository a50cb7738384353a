#include "fluid_simulation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <thread>

#include "experiment_state.h"
#include "lattice.h"
#include "quality.h"
#include "sluice/core/check.h"
#include "sluice/core/input_error.h"

namespace sluice::sim {

namespace {

int threadCount(int asked) {
  return asked > 0 ? asked : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

/// Of the longest steps: how fast particles that a body squeezes get their volume back.
constexpr double kEasingSteps = 4;

std::uint64_t bytesOf(const ParticleState& state) {
  std::uint64_t bytes = 0;
  const auto add = [&](const auto& values, const auto&) { bytes += values.size() * sizeof(values[0]); };
  state.forEachArray(state, add);
  return bytes;
}

/// Cells per axis and in all that the particles of a box are sorted into: no more than a few per particle.
CellGeometry cellsOf(const Container& container, double support, double particles) {
  constexpr double kCellsPerParticle = 8;
  constexpr double kFewCells = 1 << 16;
  std::array<double, 3> size = container.size;
  if (container.plane) size[2] = support;
  const std::array<double, 3> period = container.period();
  return CellGeometry::covering(size, support,
                                static_cast<std::uint64_t>(std::max(kFewCells, kCellsPerParticle * particles)),
                                {period[0] > 0, period[1] > 0, period[2] > 0});
}

Container checkedContainer(const v1::Simulation& settings, const SimulationOptions& options) {
  Container container = containerOf(settings);
  container.periodic = options.experiment && options.experiment->periodic;
  return container;
}

/// How many boundary particles there will be, about. Throws where the container or a body needs more than memory
/// allows.
double checkedBoundaryCount(const Container& container, const Bodies& bodies, const Discretisation& discretisation) {
  // Particles are numbered with 32 bits; 0.5: the fluid needs memory too.
  const double affordable =
      0.5 * static_cast<double>(availableMemory()) / static_cast<double>(kBytesPerBoundaryParticle);
  const double limit = std::min(affordable, 4e9);
  const auto check = [&](double count, const std::string& path, const std::string& what) {
    if (count <= limit) return;
    std::ostringstream problem;
    problem << what << " would need " << count << " boundary particles; this machine's free memory allows " << limit
            << ": use a smaller one or a larger particle_spacing";
    throw core::InputError("", path, problem.str());
  };
  double count = Boundary::expectedCount(container, discretisation);
  check(count, "simulation.container", "the container's faces");
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    count += bodies.expectedSamples(k);
    check(count, bodies.pathOf(k), "the body and what comes before it");
  }
  return count;
}

void checkPlanar(const v1::Simulation& settings) {
  if (!settings.planar() || settings.gravity().z() == 0) return;
  throw core::InputError("", "simulation.gravity.z", "must be 0: the scene is planar");
}

/// Whether two scenes choose the same members everywhere that a simulation builds on.
bool sameMethods(const v1::Simulation& a, const v1::Simulation& b) {
  const auto solverOf = [](const v1::Simulation& simulation) {
    const auto chosen = simulation.pressure_solver_case();
    return chosen == v1::Simulation::PRESSURE_SOLVER_NOT_SET ? v1::Simulation::kDfsph : chosen;
  };
  return solverOf(a) == solverOf(b) && a.has_wendland_c2() == b.has_wendland_c2() &&
         a.has_surface_tension() == b.has_surface_tension() &&
         a.surface_tension().has_he2014() == b.surface_tension().has_he2014() &&
         a.has_micropolar() == b.has_micropolar();
}

/// What applies live, besides the fluids' own fields, between scenes of the same methods.
void copyLiveFields(const v1::Simulation& from, v1::Simulation& to) {
  *to.mutable_gravity() = from.gravity();
  to.set_max_particles(from.max_particles());
  to.set_wall_adhesion(from.wall_adhesion());
  *to.mutable_time_step() = from.time_step();
  if (from.has_dfsph()) *to.mutable_dfsph() = from.dfsph();
  if (from.has_iisph()) *to.mutable_iisph() = from.iisph();
  if (from.has_pbf()) *to.mutable_pbf() = from.pbf();
  if (from.has_wcsph()) *to.mutable_wcsph() = from.wcsph();
  if (from.has_automatic_viscosity()) *to.mutable_automatic_viscosity() = from.automatic_viscosity();
  if (from.has_explicit_viscosity()) *to.mutable_explicit_viscosity() = from.explicit_viscosity();
  if (from.has_implicit_viscosity()) *to.mutable_implicit_viscosity() = from.implicit_viscosity();
  if (from.has_surface_tension()) *to.mutable_surface_tension() = from.surface_tension();
  if (from.has_micropolar()) *to.mutable_micropolar() = from.micropolar();
}

}  // namespace

FluidSimulation::FluidSimulation(const v1::Simulation& settings, const Bodies::List& bodies,
                                 const SimulationOptions& options)
    : settings_(settings),
      options_(options),
      team_(threadCount(options.threads)),
      mixture_(settings),
      container_(checkedContainer(settings, options)),
      discretisation_(discretisationOf(settings)),
      bodies_(bodies, container_, discretisation_, boundaryLayers(discretisation_)),
      boundary_(
          container_, bodies_, discretisation_,
          cellsOf(container_, discretisation_.support, checkedBoundaryCount(container_, bodies_, discretisation_)),
          team_),
      movingBodies_(bodies, container_, discretisation_, boundaryLayers(discretisation_)),
      movingBoundary_(movingBodies_, discretisation_, boundary_.grid().geometry(), boundaryLayers(discretisation_)),
      bodyStep_{movingBodies_, movingBoundary_, contacts_,
                BodyCoupling(movingBodies_, contacts_, mixture_, discretisation_.volume,
                             kEasingSteps * settings.time_step().max_seconds())},
      walls_(container_, discretisation_.spacing, bodies_, boundary_.grid().geometry(), movingBodies_),
      particleLimit_(particleLimit(discretisation_,
                                   options.availableMemory > 0 ? options.availableMemory : availableMemory(),
                                   options.mostParticles)),
      population_(settings, container_, bodies_, movingBodies_, discretisation_),
      touch_(discretisation_.spacing),
      grid_(boundary_.grid().geometry()),
      lists_(options.loops != nullptr ? *options.loops : bestPairLoops(),
             PairScale(discretisation_, container_.period())),
      solver_(makePressureSolver(settings)),
      surfaceTension_(makeSurfaceTension(settings)),
      adhesion_(discretisation_) {
  checkPlanar(settings);
  checkPeriod(container_, discretisation_.support);
  const InitialState initial = startAnew();
  if (!options_.experiment) checkOverlaps(initial);
}

void FluidSimulation::reset() { startAnew(); }

InitialState FluidSimulation::beginning() const {
  if (!options_.experiment) return initialState(settings_, container_, bodies_, particleLimit_, options_.volumeFit);
  InitialState initial;
  initial.particles = stateOf(*options_.experiment, container_);
  initial.takenOut.resize(bodies_.size());
  return initial;
}

InitialState FluidSimulation::startAnew() {
  InitialState initial = beginning();
  state_ = std::move(initial.particles);
  takenOut_ = initial.takenOut;
  misfits_ = initial.misfits;
  touch_.reset();
  added_ = 0;
  population_.reset(newParticle(), state_.size());
  if (population_.hasEmitters()) state_.born.assign(state_.size(), 0);
  movingBodies_.reset();
  solver_->reset(state_, container_);
  if (settings_.has_micropolar()) MicropolarModel::reset(state_);
  statistics_ = {};
  time_ = lastStepSeconds_ = 0;
  if (population_.hasEmitters()) population_.emit(state_, {.most = mostParticles()}, team_);
  length_ = {};
  recoverySeconds_ = std::numeric_limits<double>::infinity();
  pressureAcceleration_ = 0;
  wallContacts_ = 0;
  momentum_.reset();
  momentumDrift_.setZero();
  halted_.clear();
  freeFlight_.reset();
  maxSpeed_ = 0;
  for (const Float4& v : state_.velocity) {
    maxSpeed_ = std::max(maxSpeed_, std::sqrt(static_cast<double>(v.x * v.x + v.y * v.y + v.z * v.z)));
  }
  findPairs();
  statistics_.maxSpeed = maxSpeed_;
  statistics_.stages.clear();
  return initial;
}

/// Does what every step ends with, for particles that are in no order yet.
void FluidSimulation::findPairs() {
  StepContext start = beginStep();
  start.boundaryInReach = true;
  const StepTraits present{.particles = state_.size(), .emitting = population_.hasEmitters()};
  for (const Stage stage : planStep(settings_, present).stages) {
    if (stage == Stage::Sort || stage == Stage::Neighbours || stage == Stage::Boundary || stage == Stage::Factors ||
        stage == Stage::DensityError) {
      run(stage, start);
    }
    if (stage == Stage::Boundary) updateMovingBoundary(start);
  }
  findBoundaryInReach();
}

/// One particle with every array that the scene's particles have, as new ones start.
ParticleState FluidSimulation::newParticle() const {
  ParticleState particle;
  particle.position.resize(1);
  particle.velocity.resize(1);
  particle.densityImpulse.resize(1);
  particle.id.resize(1);
  if (mixture_.several()) particle.fluid.resize(1);
  if (keepsBirths()) particle.born.resize(1);
  makePressureSolver(settings_)->reset(particle, container_);
  if (settings_.has_micropolar()) MicropolarModel::reset(particle);
  return particle;
}

std::uint64_t FluidSimulation::mostParticles() const {
  return std::min<std::uint64_t>(settings_.max_particles(), particleLimit_.count);
}

void FluidSimulation::checkOverlaps(const InitialState& initial) const {
  // Touching volumes may stand a little closer than the lattice; half-way into each other's spacing they would burst.
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
        const InitialState::Origin& origin = initial.originOf(later);
        problem << "the " << origin.noun << " overlaps " << initial.originOf(earlier).path << ": two particles are "
                << distance << " m apart, at least " << closest << " m is allowed";
        throw core::InputError("", origin.place, problem.str());
      }
    }
  }
}

/// The wall's share in what each particle is pressed between, by sums of gradients: ½ against a flat wall. Empty where
/// no particle is near a wall, or walls answer as fluid does.
std::vector<float> FluidSimulation::wallShares() const {
  const bool inReach = boundaryInReach_ || bodiesInReach_;
  if (!inReach || wallAnswer() == WallAnswer::Mirrored || solver_->mirrorsByItself()) return {};
  const std::vector<Float4> ones(state_.size(), {1, 1, 1, 1});
  std::vector<Float4> ofFluid(state_.size());
  std::vector<float> shares(state_.size());
  // Σ V ∇W over one side of a lattice: half of what makes gradients of linear fields exact.
  const auto fullSide = static_cast<float>(0.5 / discretisation_.spacing);
  const auto norm = [](float x, float y, float z) { return std::sqrt(x * x + y * y + z * z); };
  team_.forEachChunk(state_.size(), [&](const Chunk& chunk) {
    lists_.loops().weightedGradient(lists_.chunk(chunk), ones.data(), ofFluid.data());
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      const Float4& all = lists_.gradientSum()[i];
      const Float4& fluid = ofFluid[i];
      const float wall = norm(all.x - fluid.x, all.y - fluid.y, all.z - fluid.z);
      shares[i] = wall / (wall + fullSide);
    }
  });
  return shares;
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
  // Where none has come later, every particle is there from the start.
  snapshot->ages.assign(state_.size(), static_cast<float>(time_));
  snapshot->fluids = state_.fluid;
  snapshot->supportRadius = discretisation_.support;
  snapshot->neighbours.resize(state_.size());
  const std::vector<float> restDensity(mixture_.restDensities().begin(), mixture_.restDensities().end());
  // κ = p·dt/ρ_max: u = v − dt/ρ·∇p, see Mixture. Of the density solve, which is the one that carries gravity.
  const float pressureOfImpulse =
      lastStepSeconds_ > 0 ? static_cast<float>(mixture_.heaviest() / lastStepSeconds_) : 0.0F;
  // Two particles push each other with κ_i + κ_j, twice the pressure; a wall that answers once with κ_i alone, so that
  // particles beside it carry more than the pressure that is there.
  const std::vector<float> wallShare = wallShares();
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
      if (!state_.born.empty()) snapshot->ages[i] = static_cast<float>(time_ - state_.born[i]);
      if (!wallShare.empty()) snapshot->pressures[i] /= 1 + wallShare[i];
    }
    lists_.countFluidNeighbours(chunk, snapshot->neighbours);
  });
  snapshot->bounds = core::boundsOf(snapshot->positions);
  snapshot->statistics = statistics_;
  snapshot->bodies = movingBodies_.poses();
  return snapshot;
}

void FluidSimulation::update(const v1::Scene& scene) {
  if (!scene.has_simulation()) throw core::InputError("", "simulation", "the scene has no simulation to update");
  const v1::Simulation next = atQuality(scene);
  if (next.fluids_size() != settings_.fluids_size()) {
    throw core::InputError("", "simulation.fluids", "the number of fluids cannot change while the simulation runs");
  }
  if (next.time_step().min_seconds() > next.time_step().max_seconds()) {
    throw core::InputError("", "simulation.time_step.min_seconds", "must not be more than max_seconds");
  }
  if (!sameMethods(settings_, next)) {
    throw core::InputError("", "simulation", "its methods cannot change while the simulation runs");
  }
  checkPlanar(next);
  copyLiveFields(next, settings_);
  for (int f = 0; f < next.fluids_size(); ++f) {
    settings_.mutable_fluids(f)->set_name(next.fluids(f).name());
    settings_.mutable_fluids(f)->set_viscosity(next.fluids(f).viscosity());
  }
  mixture_.setViscosities(settings_);
  solver_->update(settings_);
  // What stopped it (a smallest time step, too few iterations) may just have been changed.
  halted_.clear();
  recoverySeconds_ = std::numeric_limits<double>::infinity();
}

core::Plan FluidSimulation::plan() const {
  core::Plan plan = describe(planFor(chooseLength()));
  const auto add = [&](std::string_view name, std::uint64_t bytes) {
    plan.buffers.push_back({std::string(name), bytes});
  };
  const std::uint64_t particles = state_.size();
  add("state, twice", bytesOf(state_) + bytesOf(previous_));
  if (!beginning_.position.empty()) add("state at the step's beginning", bytesOf(beginning_));
  add("pairs and sums", lists_.bytes());
  add("pressure solve", solver_->bytes());
  add("viscosity", explicitViscosity_.bytes() + implicitViscosity_.bytes());
  if (surfaceTension_) add("surface tension", surfaceTension_->bytes());
  if (settings_.has_micropolar()) add("micropolar", micropolar_.bytes());
  add("cells", (grid_.starts().size() + 3 * particles) * sizeof(std::uint32_t));
  add("boundary", boundary_.size() * (sizeof(Float4) + sizeof(float)) +
                      (boundary_.grid().starts().size() + 3 * boundary_.size()) * sizeof(std::uint32_t));
  if (!movingBodies_.empty()) add("moving boundary", movingBoundary_.bytes() + contacts_.bytes());
  if (!bodies_.empty()) add("bodies near cells", walls_.bytes());
  return plan;
}

std::vector<std::string> FluidSimulation::notices() const {
  std::vector<std::string> notices = bodies_.notices();
  for (std::size_t k = 0; k < takenOut_.size(); ++k) {
    if (takenOut_[k] == 0) continue;
    notices.push_back(std::to_string(takenOut_[k]) + (takenOut_[k] == 1 ? " particle was" : " particles were") +
                      " taken out that would have started inside " + bodies_.nameOf(k) +
                      " or nearer than half a spacing to its surface");
  }
  if (misfits_ > 0) {
    notices.push_back(std::to_string(misfits_) + (misfits_ == 1 ? " particle was" : " particles were") +
                      " left out that the scene's volumes, filled at this quality, would have had in each other or too "
                      "near to the container's faces");
  }
  if (population_.hasEmitters() && particleLimit_.count < settings_.max_particles()) {
    notices.push_back("emitters rest while there are " + std::to_string(particleLimit_.count) +
                      " particles: " + particleLimit_.reason + " no more, simulation.max_particles is " +
                      std::to_string(settings_.max_particles()));
  }
  return notices;
}

}  // namespace sluice::sim
