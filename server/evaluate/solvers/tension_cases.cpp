// Droplets under surface tension alone.

#include <cmath>
#include <numbers>

#include "sluice/evaluate/report.h"
#include "solvers/run.h"
#include "solvers/scenes.h"

namespace sluice::evaluate {

namespace {

constexpr double kTension = 1000;  ///< σ, N/m; with ρ0 = 1000 kg/m³ and R = 1 m all units are those of the drop.
constexpr double kDensity = 1000;  ///< kg/m³.

enum class Model { Akinci, He };

/// A drop of about 1 m radius has room to swing.
v1::Simulation dropScene(double spacing, Model model, double viscosity) {
  v1::Simulation simulation = planarScene(spacing, {-2, -2, 2, 2});
  useWendland(simulation, 3);
  v1::SurfaceTension& tension = *simulation.mutable_surface_tension();
  tension.set_tension(kTension);
  if (model == Model::He) {
    tension.mutable_he2014();
  } else {
    tension.mutable_akinci2013();
  }
  simulation.mutable_fluids(0)->set_viscosity(viscosity);
  setSpeedOfSound(simulation, 20, false);
  return simulation;
}

/// Radius R that as many particles as there are make up, m.
double radiusOf(std::size_t particles, double spacing) {
  return spacing * std::sqrt(static_cast<double>(particles) / std::numbers::pi);
}

/// A disc that is set swinging between ellipses: ω² = 6 σ/(ρ R³) in the plane.
std::vector<Finding> dropletOscillation(Run& run, Model model) {
  const double spacing = 1.0 / run.resolution();
  // Amplitudes decay by exp(-4 ν t/R²): a tenth in a period, so that what particles rattle dies away.
  constexpr double kViscosity = 0.02;
  constexpr double kSwing = 0.2;  // of the radius and the frequency
  sim::Experiment experiment{.positions =
                                 latticePoints(1, 1, spacing, [](const Eigen::Vector3d& x) { return x.norm() < 1; })};
  const double radius = radiusOf(experiment.positions.size(), spacing);
  const double frequency = std::sqrt(6 * kTension / (kDensity * radius * radius * radius));
  for (const Eigen::Vector3d& x : experiment.positions) {
    experiment.velocities.emplace_back(kSwing * frequency * x.x(), -kSwing * frequency * x.y(), 0);
  }
  run.start(dropScene(spacing, model, kViscosity), std::move(experiment));
  const double period = 2 * std::numbers::pi / frequency;
  Oscillation stretch;
  const bool done = run.runTo(2.6 * period, [&](const core::ParticleSource& source) {
    const PlaneMoments moments = planeMoments(*source.snapshot());
    stretch.add(source.time(), (moments.xx - moments.yy) / (moments.xx + moments.yy));
  });
  if (!done) return {};
  return {{"period", std::abs(stretch.period() / period - 1), "Rayleigh 1879 in the plane, 6 sigma/(rho R^3)"}};
}

/// Squares that become discs: the pressure inside of them rises by σ/R. The pressure that a model's own forces raise in
/// the bulk is the same for all sizes; its part is taken out by comparing two.
std::vector<Finding> laplacePressure(Run& run, Model model) {
  constexpr double kSmaller = 0.5;  // half width of the second square over that of the first, 0.886 m: R = 1 m
  const double spacing = 1.0 / run.resolution();
  double inside[2];
  double curvature[2];
  double fastest = 0;
  for (int size = 0; size < 2; ++size) {
    const double half = std::sqrt(std::numbers::pi) / 2 * (size == 0 ? 1 : kSmaller);
    sim::Experiment experiment{.positions = latticePoints(half, half, spacing, [half](const Eigen::Vector3d& x) {
                                 return std::max(std::abs(x.x()), std::abs(x.y())) < half;
                               })};
    const double radius = radiusOf(experiment.positions.size(), spacing);
    curvature[size] = 1 / radius;
    run.start(dropScene(spacing, model, 0.2), std::move(experiment));
    double sum = 0;
    double count = 0;
    const bool done = run.runTo(3) && run.runTo(4, [&](const core::ParticleSource& source) {
      const auto particles = source.snapshot();
      for (std::size_t i = 0; i < particles->size(); ++i) {
        if (particles->positions[i].norm() > 0.5 * radius) continue;
        sum += particles->pressures[i];
        ++count;
      }
      fastest = source.statistics().maxSpeed;
    });
    if (!done) return {};
    inside[size] = sum / count;
  }
  const double slope = (inside[1] - inside[0]) / (curvature[1] - curvature[0]);
  return {
      {"pressure", std::abs(slope / kTension - 1), "Laplace, sigma/R; effective sigma " + shortText(slope / kTension)},
      {"spurious capillary number", 0.2 * kDensity * fastest / kTension, "rest"}};
}

std::vector<Finding> akinciOscillation(Run& run) { return dropletOscillation(run, Model::Akinci); }
std::vector<Finding> heOscillation(Run& run) { return dropletOscillation(run, Model::He); }
std::vector<Finding> akinciLaplace(Run& run) { return laplacePressure(run, Model::Akinci); }
std::vector<Finding> heLaplace(Run& run) { return laplacePressure(run, Model::He); }

/// Where positions are corrected after the forces, the pressures of a step are not those that balance them.
bool hasPressures(const Method& method, int) { return method.kind != SolverKind::Pbf; }

}  // namespace

std::vector<Case> tensionCases() {
  return {{"droplet oscillation, akinci2013", {10}, {10, 20, 40}, everySolver, akinciOscillation},
          {"droplet oscillation, he2014", {10}, {10, 20, 40}, everySolver, heOscillation},
          {"laplace pressure, akinci2013", {10}, {10, 20, 40}, hasPressures, akinciLaplace},
          {"laplace pressure, he2014", {10}, {10, 20, 40}, hasPressures, heLaplace}};
}

}  // namespace sluice::evaluate
