#include "stability/step_limits.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "solvers/scenes.h"
#include "stability/solver_outcome.h"

namespace sluice::evaluate {

namespace {

constexpr int kAcross = 20;
constexpr double kSpacing = 1.0 / kAcross;
constexpr double kSmoothingLength = kSpacing;  // h: half of the default kernel's support

/// A lattice that fills a periodic box, with velocities of up to `speed` at random.
Trial noisyLattice(double speed) {
  Trial trial;
  trial.simulation = planarScene(kSpacing, {0, 0, 1, 1});
  trial.experiment.positions = block(kSpacing, 0.5, kAcross, kAcross);
  trial.experiment.periodic = true;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> component(-speed, speed);
  for (std::size_t i = 0; i < trial.experiment.positions.size(); ++i) {
    trial.experiment.velocities.emplace_back(component(random), component(random), 0);
  }
  trial.speedLimit = 10 * speed;
  trial.steps = 300;
  return trial;
}

/// Whether a trial, in steps of that length, neither stops nor bursts.
bool bears(Trial trial, const Method& method, double step, int threads) {
  trial.experiment.forcedStep = step;
  // A step that is taken back is a step too long: no shorter one is tried.
  trial.simulation.mutable_time_step()->set_min_seconds(0.9 * step);
  trial.simulation.mutable_time_step()->set_max_seconds(step);
  return attempt(trial, method, threads).fate == Fate::Stable;
}

/// The longest step borne, to 3 %, between a tenth of and 30 times `unit`; 0 where even the shortest is not.
double longestStep(const Trial& trial, const Method& method, double unit, int threads) {
  double borne = 0.1 * unit;
  double tooLong = 30 * unit;
  if (!bears(trial, method, borne, threads)) return 0;
  while (tooLong / borne > 1.03) {
    const double middle = std::sqrt(borne * tooLong);
    (bears(trial, method, middle, threads) ? borne : tooLong) = middle;
  }
  return borne;
}

/// The step that the simulation would take by itself.
double ownStep(Trial trial, const Method& method, int threads) {
  trial.steps = 3;
  return attempt(trial, method, threads).shortestStep;
}

/// What a limit is compared with.
struct Bound {
  double published;  ///< Of the literature,
  double theory;     ///< and of linear theory on a lattice; NaN where none is known here.
  std::string unit;  ///< What all are multiples of.
  double unitSeconds;
  std::string reason;  ///< Why a limit that is far from these is where it is.
};

Row limitRow(const std::string& name, const Trial& trial, const Method& method, const Bound& bound, int threads) {
  const double measured = longestStep(trial, method, bound.unitSeconds, threads) / bound.unitSeconds;
  const double used = ownStep(trial, method, threads) / bound.unitSeconds;
  const double expected = std::isnan(bound.theory) ? bound.published : bound.theory;
  const bool near = std::abs(measured / expected - 1) <= 0.3;
  return {{"case", name},
          {"solver", method.solver()},
          {"unit", bound.unit},
          {"measured", measured},
          {"used", used},
          {"published", bound.published},
          {"linear_theory", bound.theory},
          {"outcome", near ? std::string("within 30 %") : bound.reason},
          // What the simulation allows itself has to be borne.
          {"passed", measured >= used}};
}

Row acousticLimit(SolverKind kind, int threads) {
  constexpr double kSound = 10;
  Trial trial = noisyLattice(1e-4 * kSound);
  setSpeedOfSound(trial.simulation, kSound, true);
  return limitRow("sound", trial, defaultMethod(kind),
                  {v1::Wcsph().courant(), latticeAcousticLimit(), "h/c0", kSmoothingLength / kSound,
                   "density diffusion is explicit too"},
                  threads);
}

Row viscousLimit(int threads) {
  constexpr double kViscosity = 0.1;
  constexpr double kSpeed = 1e-3;
  Trial trial = noisyLattice(kSpeed);
  trial.simulation.mutable_fluids(0)->set_viscosity(kViscosity);
  trial.simulation.mutable_explicit_viscosity();
  // Next to no pressure: friction alone.
  setSpeedOfSound(trial.simulation, 1e-2 * kSpeed, true);
  return limitRow("explicit viscosity", trial, defaultMethod(SolverKind::Wcsph),
                  {0.125, std::nan(""), "h^2/nu", kSmoothingLength * kSmoothingLength / kViscosity,
                   "the bound of Morris et al. 1997 keeps a margin"},
                  threads);
}

Row tensionLimit(bool he, int threads) {
  constexpr double kTension = 1000;
  constexpr double kDensity = 1000;
  Trial trial;
  trial.simulation = planarScene(kSpacing, {-2, -2, 2, 2});
  v1::SurfaceTension& tension = *trial.simulation.mutable_surface_tension();
  tension.set_tension(kTension);
  if (he) tension.mutable_he2014();
  trial.experiment.positions =
      latticePoints(0.5, 0.5, kSpacing, [](const Eigen::Vector3d& x) { return x.norm() < 0.5; });
  // Twice the speed of capillary waves as short as a spacing.
  trial.speedLimit = 2 * std::sqrt(2 * std::numbers::pi * kTension / (kDensity * kSpacing));
  trial.steps = 150;
  const double unit = std::sqrt(kDensity * std::pow(kSmoothingLength, 3) / (2 * std::numbers::pi * kTension));
  return limitRow(he ? "surface tension, he2014" : "surface tension, akinci2013", trial,
                  defaultMethod(SolverKind::Dfsph),
                  {0.25, std::nan(""), "sqrt(rho h^3/(2 pi sigma))", unit,
                   "the bound of Brackbill et al. 1992 is for waves on a grid; the pressure solve damps particles"},
                  threads);
}

}  // namespace

double latticeAcousticLimit() {
  constexpr double kSupport = 2;  // spacings
  // The gradient of the cubic spline in the plane, V ∂W/∂r of a lattice of spacing 1.
  const auto slope = [](double r) {
    const double q = r / kSupport;
    const double t = std::max(1 - q, 0.0);
    const double m = std::max(1 - 2 * q, 0.0);
    return 40 / (7 * std::numbers::pi) / std::pow(kSupport, 3) * 6 * (m * m - t * t);
  };
  double fastest = 0;
  constexpr int kWaves = 32;
  for (int a = 0; a <= kWaves; ++a) {
    for (int b = 0; b <= a; ++b) {
      double sumX = 0;
      double sumY = 0;
      for (int y = -2; y <= 2; ++y) {
        for (int x = -2; x <= 2; ++x) {
          const double r = std::hypot(x, y);
          if (r == 0 || r >= kSupport) continue;
          const double wave = std::sin(std::numbers::pi * (a * x + b * y) / kWaves);
          sumX += slope(r) * x / r * wave;
          sumY += slope(r) * y / r * wave;
        }
      }
      fastest = std::max(fastest, std::hypot(sumX, sumY));
    }
  }
  // ω = c0 |Σ V ∇W sin k·x|, and h is a spacing.
  return 2 / fastest;
}

std::vector<StabilityJob> limitJobs(int threads) {
  const auto one = [](Row row) { return std::vector<Row>{std::move(row)}; };
  return {{"longest step, sound, wcsph", [=] { return one(acousticLimit(SolverKind::Wcsph, threads)); }},
          {"longest step, sound, delta_sph", [=] { return one(acousticLimit(SolverKind::DeltaSph, threads)); }},
          {"longest step, explicit viscosity", [=] { return one(viscousLimit(threads)); }},
          {"longest step, tension, akinci2013", [=] { return one(tensionLimit(false, threads)); }},
          {"longest step, tension, he2014", [=] { return one(tensionLimit(true, threads)); }}};
}

}  // namespace sluice::evaluate
