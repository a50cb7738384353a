#include "stability/stiffness_cases.h"

#include <cmath>
#include <numbers>

#include "solvers/scenes.h"

namespace sluice::evaluate {

namespace {

constexpr double kGravity = 9.81;

/// A lattice in a periodic box that is sheared by up to 1 m/s, in implicit steps of `number` h²/ν.
Trial shear(double number) {
  constexpr int kAcross = 20;
  constexpr double kSpacing = 1.0 / kAcross;
  constexpr double kStep = 1e-3;
  Trial trial;
  trial.simulation = planarScene(kSpacing, {0, 0, 1, 1});
  trial.simulation.mutable_implicit_viscosity();
  trial.simulation.mutable_fluids(0)->set_viscosity(number * kSpacing * kSpacing / kStep);
  trial.simulation.mutable_time_step()->set_max_seconds(kStep);
  setSpeedOfSound(trial.simulation, 10, false);
  trial.experiment.positions = block(kSpacing, 0.5, kAcross, kAcross);
  trial.experiment.periodic = true;
  for (const Eigen::Vector3d& x : trial.experiment.positions) {
    trial.experiment.velocities.emplace_back(std::sin(2 * M_PI * x.y()), 0, 0);
  }
  trial.speedLimit = 1.1;
  trial.steps = 50;
  return trial;
}

/// A square block that has fallen 100 m.
Trial fallen() {
  constexpr double kSpacing = 0.05;
  const double speed = std::sqrt(2 * kGravity * 100);
  Trial trial;
  trial.simulation = planarScene(kSpacing, {0, 0, 4, 4});
  trial.simulation.mutable_gravity()->set_y(-kGravity);
  trial.experiment.positions = block(kSpacing, 1, 20, 20);
  for (Eigen::Vector3d& x : trial.experiment.positions) {
    x += Eigen::Vector3d(1.5, 0.2, 0);
    trial.experiment.velocities.emplace_back(0, -speed, 0);
  }
  // Jets along the floor are faster than what falls, but not by this.
  trial.speedLimit = 4 * speed;
  trial.steps = 300;
  return trial;
}

/// A disc under tension that pulls 1000 times as hard as water's, in steps of up to ten times what Brackbill et al.
/// 1992 allow it.
Trial tenfoldTensionStep(bool he) {
  constexpr double kSpacing = 0.05;
  constexpr double kTension = 73;
  constexpr double kDensity = 1000;
  Trial trial;
  trial.simulation = planarScene(kSpacing, {-2, -2, 2, 2});
  trial.simulation.mutable_surface_tension()->set_tension(kTension);
  if (he) trial.simulation.mutable_surface_tension()->mutable_he2014();
  // The smoothing length of the default kernel is a spacing.
  const double bound = 0.25 * std::sqrt(kDensity * std::pow(kSpacing, 3) / (2 * std::numbers::pi * kTension));
  trial.simulation.mutable_time_step()->set_max_seconds(10 * bound);
  trial.experiment.positions =
      latticePoints(0.5, 0.5, kSpacing, [](const Eigen::Vector3d& x) { return x.norm() < 0.5; });
  // Of capillary waves as short as a spacing.
  const double speed = std::sqrt(2 * std::numbers::pi * kTension / (kDensity * kSpacing));
  setSpeedOfSound(trial.simulation, 10 * speed, true);
  trial.speedLimit = 2 * speed;
  trial.seconds = 100 * bound;
  trial.steps = 5000;
  return trial;
}

void addTenfoldStep(std::vector<StabilityJob>& jobs, int threads) {
  for (const Method& method : solverMethods(true)) {
    Trial trial = column(25);
    trial.simulation.mutable_time_step()->set_max_seconds(5e-4);
    trial.seconds = 0;
    trial.steps = 200;
    v1::Scene longer;
    *longer.mutable_simulation() = trial.simulation;
    choose(*longer.mutable_simulation(), method);
    longer.mutable_simulation()->mutable_time_step()->set_max_seconds(5e-3);
    trial.halfWay = [longer](core::ParticleSource& source) { source.update(longer); };
    jobs.push_back(solverJob("a step ten times as long as the last", trial, method, threads));
  }
}

void addColumns(std::vector<StabilityJob>& jobs, int threads) {
  for (const int layers : {25, 50, 100, 200}) {
    const std::string height = "column of " + std::to_string(layers) + " layers";
    Trial cold = column(layers);
    cold.simulation.mutable_dfsph()->set_warm_start(false);
    for (const Method& method : solverMethods(true)) {
      const bool startsWarm = method.kind == SolverKind::Dfsph;
      jobs.push_back(solverJob(height + (startsWarm ? ", warm starts" : ""), column(layers), method, threads));
      if (startsWarm) jobs.push_back(solverJob(height + ", cold starts", cold, method, threads));
    }
  }
}

void addFasterSound(std::vector<StabilityJob>& jobs, int threads) {
  for (const Method& method : solverMethods(true)) {
    if (method.courant == 0) continue;
    Trial trial = column(25);
    // Ten times what 0 takes, ten times √(2 g H).
    setSpeedOfSound(trial.simulation, 100 * trial.speedLimit, false);
    trial.seconds = 0;
    trial.steps = 1000;
    jobs.push_back(solverJob("sound ten times as fast", trial, method, threads));
  }
}

}  // namespace

Trial column(int layers) {
  constexpr double kSpacing = 0.02;
  // Wide enough that particles in the middle see no wall; a deep one is made no wider, to stay cheap.
  const int columns = layers < 100 ? 10 : 6;
  Trial trial;
  trial.simulation = planarScene(kSpacing, {0, 0, (columns + 1) * kSpacing, kSpacing * (1.3 * layers + 2)});
  trial.simulation.mutable_gravity()->set_y(-kGravity);
  trial.simulation.mutable_fluids(0)->set_viscosity(1e-3);
  trial.experiment.positions = block(kSpacing, 1, columns, layers);
  // What its whole height falls to.
  trial.speedLimit = std::sqrt(2 * kGravity * kSpacing * layers);
  trial.seconds = 0.5;
  trial.steps = 10000;
  return trial;
}

std::vector<StabilityJob> stiffnessJobs(bool quick, int threads) {
  std::vector<StabilityJob> jobs;
  addColumns(jobs, threads);
  for (const double number : quick ? std::vector<double>{1e-2, 1e4} : std::vector<double>{1e-2, 1, 1e2, 1e4}) {
    addForEverySolver(jobs, "implicit viscosity, nu dt/d^2 = " + shortText(number), shear(number), threads);
  }
  addForEverySolver(jobs, "a block that has fallen 100 m", fallen(), threads);
  addTenfoldStep(jobs, threads);
  addForEverySolver(jobs, "tension in steps of up to 10 dt, akinci2013", tenfoldTensionStep(false), threads);
  addForEverySolver(jobs, "tension in steps of up to 10 dt, he2014", tenfoldTensionStep(true), threads);
  addFasterSound(jobs, threads);
  return jobs;
}

}  // namespace sluice::evaluate
