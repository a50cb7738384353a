#include "stability/particle_cases.h"

#include <cmath>
#include <limits>

#include "solvers/scenes.h"
#include "stability/solver_outcome.h"

namespace sluice::evaluate {

namespace {

constexpr double kSpacing = 0.05;

struct ParticleCase {
  std::string name;
  Trial trial;
  bool mustBeRefused = false;
};

Trial inTank(std::vector<Eigen::Vector3d> positions, std::vector<Eigen::Vector3d> velocities = {}) {
  Trial trial;
  trial.simulation = planarScene(kSpacing, {0, 0, 1, 1});
  trial.simulation.mutable_gravity()->set_y(-9.81);
  trial.simulation.mutable_fluids(0)->clear_viscosity();
  trial.experiment.positions = std::move(positions);
  trial.experiment.velocities = std::move(velocities);
  return trial;
}

/// A fluid of 1000 kg/m³ with one of 1 kg/m³ above or below, as a scene says it.
Trial layers(double lower, double upper) {
  Trial trial = inTank({});
  trial.isExperiment = false;
  trial.seconds = 0.5;
  trial.steps = 10000;
  // What the heavy one gives where it falls by the depth of the light one, which can be thrown out far faster.
  trial.energyLimit = 9.81 * 8 * kSpacing;
  trial.simulation.clear_fluids();
  trial.simulation.mutable_container()->mutable_max()->set_y(1.2);
  for (const double density : {lower, upper}) {
    v1::Fluid& fluid = *trial.simulation.add_fluids();
    fluid.set_rest_density(density);
    v1::Block& fill = *fluid.add_blocks();
    fill.mutable_first_particle()->set_x(kSpacing);
    fill.mutable_first_particle()->set_y(kSpacing * (trial.simulation.fluids_size() == 1 ? 1 : 9));
    fill.mutable_first_particle()->set_z(0);
    fill.set_count_x(19);
    fill.set_count_y(8);
  }
  return trial;
}

std::vector<ParticleCase> particleCases() {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  const Eigen::Vector3d middle(0.5, 0.5, 0);
  const std::vector<Eigen::Vector3d> pool = block(kSpacing, 1, 19, 8);
  std::vector<Eigen::Vector3d> fast(pool.size(), Eigen::Vector3d::Zero());
  fast.back() = {1e6, 0, 0};
  std::vector<Eigen::Vector3d> inWall = pool;
  inWall.front() = {0.1 * kSpacing, 0.1 * kSpacing, 0};
  Trial empty = inTank({});
  empty.isExperiment = false;
  return {{"no particles", inTank({})},
          {"no particles, as a scene", empty, true},
          {"one particle", inTank({middle})},
          {"two that coincide", inTank({middle, middle})},
          {"a hundred that coincide", inTank(std::vector<Eigen::Vector3d>(100, middle))},
          {"a position that is not a number", inTank({{0.5, kNaN, 0}}), true},
          {"an infinite position", inTank({{kInfinite, 0.5, 0}}), true},
          {"an infinite velocity", inTank({middle}, {{kInfinite, 0, 0}}), true},
          {"one outside of the container", inTank({{1.5, 0.5, 0}}), true},
          {"one in a wall", inTank(inWall)},
          {"one of a pool at 1e6 m/s", inTank(pool, fast)},
          {"a light fluid on one 1000 times as heavy", layers(1000, 1)},
          {"a heavy fluid on one 1000 times as light", layers(1, 1000)}};
}

}  // namespace

std::vector<StabilityJob> particleJobs(int threads) {
  std::vector<StabilityJob> jobs;
  for (const ParticleCase& particles : particleCases()) {
    for (const Method& method : solverMethods(true)) {
      jobs.push_back({particles.name + ", " + method.solver(), [=]() -> std::vector<Row> {
                        const SolverOutcome outcome = attempt(particles.trial, method, threads);
                        const bool refused = outcome.fate == Fate::Refused;
                        const bool passed = particles.mustBeRefused ? refused : isHonest(outcome);
                        return {toRow(particles.name, method.solver(), outcome, passed)};
                      }});
    }
  }
  return jobs;
}

}  // namespace sluice::evaluate
