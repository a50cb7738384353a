// Cases whose solution is a straight line: free fall and columns at rest.

#include <algorithm>
#include <cmath>

#include "solvers/run.h"
#include "solvers/scenes.h"

namespace sluice::evaluate {

namespace {

constexpr double kGravity = 9.81;

/// A lone particle, thrown: x = x0 + v0 t + ½ g t². The resolution is steps per second.
std::vector<Finding> freeFall(Run& run) {
  v1::Simulation simulation = planarScene(0.01, {-10, -10, 10, 10});
  simulation.mutable_gravity()->set_y(-kGravity);
  simulation.mutable_time_step()->set_max_seconds(1.0 / run.resolution());
  simulation.mutable_time_step()->set_cfl(1);
  // So that no other bound than the length asked for is met.
  setSpeedOfSound(simulation, 1e-3, false);
  simulation.mutable_wcsph()->set_courant(1);
  const Eigen::Vector3d start(0, 1, 0);
  const Eigen::Vector3d velocity(2, 3, 0);
  run.start(simulation, {.positions = {start}, .velocities = {velocity}});
  if (!run.runTo(1)) return {};
  const Eigen::Vector3d exact = start + velocity + Eigen::Vector3d(0, -0.5 * kGravity, 0);
  const double error = (run.particles()->positions[0].cast<double>() - exact).norm();
  return {{"position after 1 s, m", error, "x0 + v0 t + g t^2/2"}};
}

/// Pressure of every particle, the mean of some steps; single ones flicker about it.
class MeanPressure {
 public:
  void add(const core::ParticleSource& source) {
    const auto particles = source.snapshot();
    sums_.resize(particles->size());
    for (std::size_t i = 0; i < particles->size(); ++i) sums_[particles->ids[i]] += particles->pressures[i];
    ++count_;
  }
  double of(std::uint32_t id) const { return sums_[id] / count_; }

 private:
  std::vector<double> sums_;
  int count_ = 0;
};

/// A column 1 m high at rest in a tank half as wide, narrower where 25 particles are, p = ρ0 g (H - y).
std::vector<Finding> settle(Run& run, bool warmStart) {
  const int layers = run.resolution();
  const double spacing = 1.0 / layers;
  const int columns = std::min(layers / 2, 25);
  v1::Simulation simulation = planarScene(spacing, {0, 0, (columns + 1) * spacing, 1.5});
  simulation.mutable_gravity()->set_y(-kGravity);
  simulation.mutable_fluids(0)->clear_viscosity();
  simulation.mutable_dfsph()->set_warm_start(warmStart);
  // A twenty-fifth of the time in which a particle falls by about its spacing: pressure has to travel the whole height
  // in the iterations of a step.
  simulation.mutable_time_step()->set_max_seconds(0.04 * std::sqrt(spacing / kGravity));
  run.start(simulation, {.positions = block(spacing, 1, columns, layers)});

  const double end = 5 / std::sqrt(kGravity);
  MeanPressure pressure;
  double fastest = 0;
  const bool done = run.runTo(0.9 * end) && run.runTo(end, [&](const core::ParticleSource& source) {
    pressure.add(source);
    fastest = std::max(fastest, source.statistics().maxSpeed);
  });
  if (!done) return {};

  const auto particles = run.particles();
  double top = 0;
  for (const Eigen::Vector3f& x : particles->positions) top = std::max(top, static_cast<double>(x.y()));
  std::vector<double> means;
  for (const std::uint32_t id : particles->ids) means.push_back(pressure.of(id));
  const std::vector<double> field = interpolated(*particles, means);
  RelativeL2 error;
  RelativeL2 inside;
  const double right = (columns + 1) * spacing;
  for (std::size_t i = 0; i < particles->size(); ++i) {
    const double depth = top + 0.5 * spacing - particles->positions[i].y();
    const double exact = particles->restDensity * kGravity * depth;
    error.add(field[i], exact);
    // Farther than a support from the tank's faces.
    const Eigen::Vector3f& x = particles->positions[i];
    const double wall = std::min({static_cast<double>(x.y()), static_cast<double>(x.x()), right - x.x()});
    if (wall > particles->supportRadius + spacing) inside.add(field[i], exact);
  }
  return {{"L2 of pressure, a support from walls", inside.value(), "rho g (H - y)"},
          {"L2 of pressure", error.value(), "rho g (H - y)"},
          {"largest speed over sqrt(g H)", fastest / std::sqrt(kGravity), "rest"}};
}

std::vector<Finding> warmColumn(Run& run) { return settle(run, true); }
std::vector<Finding> coldColumn(Run& run) { return settle(run, false); }

/// The deepest columns take weakly compressible solvers so many steps that their default alone is affordable.
bool isAffordable(const Method& method, int layers) {
  constexpr int kDeep = 100;
  return method.courant == 0 || layers < kDeep || isDefault(method);
}

bool startsWarm(const Method& method, int) { return method.kind == SolverKind::Dfsph; }

}  // namespace

std::vector<Case> restCases() {
  return {{"free fall", {250, 1000}, {125, 250, 500, 1000}, everySolver, freeFall},
          {"hydrostatic column", {25, 50}, {25, 50, 100, 200}, isAffordable, warmColumn},
          {"hydrostatic column, cold starts", {25, 50}, {25, 50, 100, 200}, startsWarm, coldColumn}};
}

}  // namespace sluice::evaluate
