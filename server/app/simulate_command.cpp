#include <chrono>
#include <cstdio>
#include <memory>

#include <CLI/CLI.hpp>

#include "command_options.h"
#include "commands.h"
#include "json.h"
#include "sluice/core/input_error.h"
#include "statistics.h"

namespace sluice::app {

namespace {

struct SimulateOptions {
  SceneOptions scene;
  double until = 1;
};

struct Figures {
  std::size_t particles = 0;
  std::uint64_t steps = 0;
  double simulatedSeconds = 0;
  double wallSeconds = 0;
  core::StageTimes stages;  ///< Mean ms per step.
  double meanDensityError = 0;
  double maxDensityError = 0;
  double meanDensityIterations = 0;
  double meanDivergenceIterations = 0;

  double millisecondsPerStep() const { return steps == 0 ? 0 : 1000 * wallSeconds / static_cast<double>(steps); }
};

/// Steps to the given time. Density errors are the largest of any step: the mean over particles, and the worst
/// particle.
Figures run(core::ParticleSource& source, double until) {
  using Clock = std::chrono::steady_clock;
  Figures figures;
  core::StageTimes sums;
  double densityIterations = 0;
  double divergenceIterations = 0;
  std::chrono::duration<double> wall{};
  while (source.time() < until) {
    const auto start = Clock::now();
    const bool moved = source.advance();
    wall += Clock::now() - start;
    if (!moved) break;
    ++figures.steps;
    const core::StepStatistics step = source.statistics();
    for (const core::StageTime& stage : step.stages) core::addStageTime(sums, stage.name, stage.milliseconds);
    figures.meanDensityError = std::max(figures.meanDensityError, step.meanDensityError);
    figures.maxDensityError = std::max(figures.maxDensityError, step.maxDensityError);
    densityIterations += step.densityIterations;
    divergenceIterations += step.divergenceIterations;
  }
  figures.particles = source.snapshot()->size();
  figures.simulatedSeconds = source.time();
  figures.wallSeconds = wall.count();
  figures.stages = meanStageTimes(sums, figures.steps);
  const double steps = static_cast<double>(std::max<std::uint64_t>(figures.steps, 1));
  figures.meanDensityIterations = densityIterations / steps;
  figures.meanDivergenceIterations = divergenceIterations / steps;
  return figures;
}

void printText(const Figures& f) {
  std::printf("%zu particles, %llu steps, %.4f s simulated in %.3f s (%.2f ms a step)\n", f.particles,
              static_cast<unsigned long long>(f.steps), f.simulatedSeconds, f.wallSeconds, f.millisecondsPerStep());
  std::printf(
      "density error: mean %.4f %%, max %.3f %% (largest of any step); iterations: density %.1f, divergence %.1f\n",
      100 * f.meanDensityError, 100 * f.maxDensityError, f.meanDensityIterations, f.meanDivergenceIterations);
  for (const core::StageTime& stage : f.stages)
    std::printf("  %-28s %8.3f ms\n", stage.name.c_str(), stage.milliseconds);
}

void printJson(const Figures& f) {
  const Json json = {{"particles", f.particles},
                     {"steps", f.steps},
                     {"simulated_seconds", f.simulatedSeconds},
                     {"wall_seconds", f.wallSeconds},
                     {"milliseconds_per_step", f.millisecondsPerStep()},
                     {"stages", toJson(f.stages)},
                     {"mean_density_error", f.meanDensityError},
                     {"max_density_error", f.maxDensityError},
                     {"density_iterations", f.meanDensityIterations},
                     {"divergence_iterations", f.meanDivergenceIterations}};
  std::printf("%s\n", json.dump().c_str());
}

int simulate(const SimulateOptions& options) {
  const LiveScene live = options.scene.load();
  const std::unique_ptr<core::ParticleSource> source = openSource(live.scene, options.scene.threads);
  const Figures figures = run(*source, options.until);
  options.scene.json ? printJson(figures) : printText(figures);
  if (!source->halted().empty()) throw core::EnvironmentError("the simulation halted: " + source->halted());
  return 0;
}

}  // namespace

void addSimulateCommand(CLI::App& program, Command& chosen) {
  const auto options = std::make_shared<SimulateOptions>();
  CLI::App& verb = *program.add_subcommand("simulate", "Run a scene without drawing and print what it cost");
  addSceneOptions(verb, options->scene, "", true);
  verb.add_option("--until", options->until, "Simulated time to stop at, s")
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str();
  verb.callback([options, &chosen] { chosen = [options] { return simulate(*options); }; });
}

}  // namespace sluice::app
