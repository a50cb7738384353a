#include "stability/stiffness_cases.h"

#include <algorithm>
#include <cmath>

#include "machine.h"
#include "scatter_plot.h"
#include "solvers/scenes.h"
#include "stability/solver_outcome.h"

namespace sluice::evaluate {

namespace {

constexpr double kGravity = 9.81;

/// A column of water of spacing 0.02 m at rest in a tank ten particles wide.
Trial column(int layers) {
  constexpr double kSpacing = 0.02;
  constexpr int kColumns = 10;
  Trial trial;
  trial.simulation = planarScene(kSpacing, {0, 0, (kColumns + 1) * kSpacing, kSpacing * (1.3 * layers + 2)});
  trial.simulation.mutable_gravity()->set_y(-kGravity);
  trial.simulation.mutable_fluids(0)->set_viscosity(1e-3);
  trial.experiment.positions = block(kSpacing, 1, kColumns, layers);
  // What its whole height falls to.
  trial.speedLimit = std::sqrt(2 * kGravity * kSpacing * layers);
  return trial;
}

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

Trial tenfoldStep() {
  Trial trial = column(25);
  trial.simulation.mutable_time_step()->set_max_seconds(5e-4);
  trial.steps = 200;
  return trial;
}

/// A square that turns at 1 rad/s: held together by pressures below 0 alone.
Trial turningSquare(bool negativePressure) {
  constexpr double kSpacing = 0.05;
  Trial trial;
  trial.simulation = planarScene(kSpacing, {-3, -3, 3, 3});
  setSpeedOfSound(trial.simulation, 10, negativePressure);
  trial.experiment.positions = latticePoints(
      0.5, 0.5, kSpacing, [](const Eigen::Vector3d& x) { return std::abs(x.x()) < 0.5 && std::abs(x.y()) < 0.5; });
  for (const Eigen::Vector3d& x : trial.experiment.positions)
    trial.experiment.velocities.emplace_back(x.y(), -x.x(), 0);
  trial.speedLimit = 2;
  trial.steps = 400;
  return trial;
}

bool isWeaklyCompressible(const Method& method) { return method.courant > 0; }

bool sound(const SolverOutcome& outcome) {
  return outcome.fate == Fate::Stable || outcome.fate == Fate::Recovered || outcome.fate == Fate::Stopped;
}

class StiffnessCases {
 public:
  explicit StiffnessCases(const Options& options) : options_(options) {}

  std::vector<Row> run() {
    for (const int layers : options_.quick ? std::vector<int>{25, 50} : std::vector<int>{25, 50, 100, 200}) {
      all("cold column of " + std::to_string(layers) + " layers", column(layers));
    }
    for (const double number :
         options_.quick ? std::vector<double>{1e-2, 1e4} : std::vector<double>{1e-2, 1, 1e2, 1e4}) {
      all("implicit viscosity, nu dt/d^2 = " + shortText(number), shear(number));
    }
    all("a block that has fallen 100 m", fallen());
    jump();
    fasterSound();
    tension();
    return std::move(rows_);
  }

 private:
  void all(const std::string& name, const Trial& trial) {
    options_.tell(name);
    for (const Method& method : solverMethods(true)) add(name, trial, method);
  }

  void add(const std::string& name, const Trial& trial, const Method& method) {
    const SolverOutcome outcome = attempt(trial, method, options_.threads);
    rows_.push_back(toRow(name, method.solver(), outcome, sound(outcome)));
  }

  void jump() {
    options_.tell("a step ten times as long");
    for (const Method& method : solverMethods(true)) {
      Trial trial = tenfoldStep();
      trial.halfWay = [&](core::ParticleSource& source) {
        v1::Scene scene;
        *scene.mutable_simulation() = trial.simulation;
        choose(*scene.mutable_simulation(), method);
        scene.mutable_simulation()->mutable_time_step()->set_max_seconds(5e-3);
        source.update(scene);
      };
      add("a step ten times as long as the last", trial, method);
    }
  }

  void fasterSound() {
    for (const Method& method : solverMethods(true)) {
      if (!isWeaklyCompressible(method)) continue;
      Trial trial = column(25);
      // Ten times what 0 takes, ten times √(2 g H).
      setSpeedOfSound(trial.simulation, 100 * trial.speedLimit, false);
      trial.steps = 1000;
      add("sound ten times as fast", trial, method);
    }
  }

  /// Where p ≥ 0 is clamped nothing holds the square: particles fly straight on. Shown, not hidden.
  void tension() {
    for (const Method& method : solverMethods(true)) {
      const bool clamps = !isWeaklyCompressible(method);
      SolverOutcome outcome = attempt(turningSquare(true), method, options_.threads);
      Row row = toRow("rotating square, pressures below 0", method.solver(), outcome, sound(outcome));
      if (clamps) row.set("outcome", "comes apart: pressures below 0 are clamped (" + outcome.text() + ")");
      rows_.push_back(std::move(row));
      if (!clamps) add("rotating square, pressures clamped at 0", turningSquare(false), method);
    }
  }

  const Options& options_;
  std::vector<Row> rows_;
};

}  // namespace

std::vector<Row> stiffnessStability(const Options& options) { return StiffnessCases(options).run(); }

std::vector<Document> stabilityMaps(const Options& options, std::vector<Row>& rows) {
  const std::vector<int> heights = options.quick ? std::vector<int>{10, 40} : std::vector<int>{10, 20, 40, 80, 160};
  const std::vector<double> steps = options.quick ? std::vector<double>{5e-4, 4e-3}
                                                  : std::vector<double>{1.25e-4, 2.5e-4, 5e-4, 1e-3, 2e-3, 4e-3, 8e-3};
  std::vector<Document> maps;
  for (const Method& method : solverMethods(true)) {
    options.tell("map of " + method.solver());
    ScatterPlot plot;
    plot.title = method.text() + ": columns by height and step";
    plot.subtitle = processorName();
    plot.xLabel = "layers of particles";
    plot.yLabel = "step, s";
    plot.fillKey = {"stable", "recovered by smaller steps", "stopped or bursts"};
    PlotSeries series[3];
    for (int k = 0; k < 3; ++k) {
      series[k].name = plot.fillKey[static_cast<std::size_t>(k)];
      series[k].line = false;
      series[k].colour = k;
      series[k].fill = static_cast<PlotSeries::Fill>(k);
    }
    for (const int layers : heights) {
      for (const double step : steps) {
        Trial trial = column(layers);
        trial.experiment.forcedStep = step;
        trial.steps = 60;
        const SolverOutcome outcome = attempt(trial, method, options.threads);
        const int kind = outcome.fate == Fate::Stable ? 0 : outcome.fate == Fate::Recovered ? 1 : 2;
        series[kind].points.push_back({static_cast<double>(layers), step, outcome.text()});
        Row row = toRow("map: " + std::to_string(layers) + " layers, steps of " + shortText(step) + " s",
                        method.solver(), outcome, outcome.fate != Fate::NotFinite);
        rows.push_back(std::move(row));
      }
    }
    for (PlotSeries& s : series) {
      if (!s.points.empty()) plot.series.push_back(std::move(s));
    }
    maps.push_back({"stability_map_" + method.solver() + ".svg", drawSvg(plot)});
  }
  return maps;
}

}  // namespace sluice::evaluate
