// What no force from outside can change.

#include <cmath>

#include "solvers/run.h"
#include "solvers/scenes.h"

namespace sluice::evaluate {

namespace {

/// Two squares of viscous fluid that collide off-centre in free space.
std::vector<Finding> collision(Run& run) {
  const double spacing = 1.0 / run.resolution();
  v1::Simulation simulation = planarScene(spacing, {-4, -4, 4, 4});
  simulation.mutable_fluids(0)->set_viscosity(0.01);
  setSpeedOfSound(simulation, 20, false);
  sim::Experiment experiment;
  for (const double side : {-1.0, 1.0}) {
    for (const Eigen::Vector3d& x : block(spacing, 0.5, run.resolution(), run.resolution())) {
      experiment.positions.emplace_back(x.x() - 0.5 + side * 0.6, x.y() - 0.5 + side * 0.2, 0);
      experiment.velocities.emplace_back(-side * 1.5, 0, 0);
    }
  }
  run.start(simulation, std::move(experiment));
  const PlaneMoments before = planeMoments(*run.particles());
  double highest = before.kinetic;
  const bool done = run.runTo(0.5, [&](const core::ParticleSource& source) {
    highest = std::max(highest, planeMoments(*source.snapshot()).kinetic);
  });
  if (!done) return {};
  const PlaneMoments after = planeMoments(*run.particles());
  const double speed = std::sqrt(2 * before.kinetic);
  return {{"momentum drift over m v", (after.momentum - before.momentum).norm() / speed, "kept, to round-off"},
          {"angular momentum drift", std::abs(after.spin / before.spin - 1), "kept"},
          {"energy gained", highest / before.kinetic - 1, "never"}};
}

}  // namespace

std::vector<Case> conservationCases() { return {{"collision", {16, 32}, {16, 32, 64}, everySolver, collision}}; }

}  // namespace sluice::evaluate
