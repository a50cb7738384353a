#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>

#include "command_options.h"
#include "commands.h"
#include "frame_export.h"
#include "json.h"
#include "sluice/app/saved_state.h"
#include "sluice/core/input_error.h"
#include "statistics.h"

namespace sluice::app {

namespace {

struct SimulateOptions {
  SceneOptions scene;
  double until = 1;
  std::string out;
  std::string format = "bgeo";
  double framesPerSecond = 25;
  std::string save;
  std::string resume;
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
  core::FlowMeasures flow;             ///< At the end.
  std::optional<std::uint64_t> files;  ///< Written, where any were to be.

  double millisecondsPerStep() const { return steps == 0 ? 0 : 1000 * wallSeconds / static_cast<double>(steps); }
};

/// Steps a source and takes down how that goes. Density errors are the largest of any step: the mean over particles,
/// and the worst particle.
class MeasuredRun {
 public:
  explicit MeasuredRun(core::ParticleSource& source) : source_(source), startSeconds_(source.time()) {}

  /// Steps to the first state at or after `time`, s; returns false where the source has none.
  bool advanceTo(double time) {
    while (source_.time() < time) {
      if (!step()) return false;
    }
    return true;
  }

  Figures figures() const {
    Figures figures = figures_;
    figures.particles = source_.snapshot()->size();
    figures.flow = source_.measures();
    figures.simulatedSeconds = source_.time() - startSeconds_;
    figures.wallSeconds = wall_.count();
    figures.stages = meanStageTimes(stageSums_, figures.steps);
    const double steps = static_cast<double>(std::max<std::uint64_t>(figures.steps, 1));
    figures.meanDensityIterations /= steps;
    figures.meanDivergenceIterations /= steps;
    return figures;
  }

 private:
  using Clock = std::chrono::steady_clock;

  bool step() {
    const auto start = Clock::now();
    const bool moved = source_.advance();
    wall_ += Clock::now() - start;
    if (!moved) return false;
    ++figures_.steps;
    const core::StepStatistics step = source_.statistics();
    for (const core::StageTime& stage : step.stages) core::addStageTime(stageSums_, stage.name, stage.milliseconds);
    figures_.meanDensityError = std::max(figures_.meanDensityError, step.meanDensityError);
    figures_.maxDensityError = std::max(figures_.maxDensityError, step.maxDensityError);
    figures_.meanDensityIterations += step.densityIterations;
    figures_.meanDivergenceIterations += step.divergenceIterations;
    return true;
  }

  core::ParticleSource& source_;
  double startSeconds_;
  Figures figures_;  ///< With sums where `figures` gives means.
  core::StageTimes stageSums_;
  std::chrono::duration<double> wall_{};
};

void printText(const Figures& f) {
  std::printf("%zu particles, %llu steps, %.4f s simulated in %.3f s (%.2f ms a step)\n", f.particles,
              static_cast<unsigned long long>(f.steps), f.simulatedSeconds, f.wallSeconds, f.millisecondsPerStep());
  std::printf(
      "density error: mean %.4f %%, max %.3f %% (largest of any step); iterations: density %.1f, divergence %.1f\n",
      100 * f.meanDensityError, 100 * f.maxDensityError, f.meanDensityIterations, f.meanDivergenceIterations);
  for (const core::StageTime& stage : f.stages)
    std::printf("  %-28s %8.3f ms\n", stage.name.c_str(), stage.milliseconds);
  if (f.files) std::printf("%llu files written\n", static_cast<unsigned long long>(*f.files));
}

void printJson(const Figures& f) {
  Json json = {{"particles", f.particles},
               {"steps", f.steps},
               {"simulated_seconds", f.simulatedSeconds},
               {"wall_seconds", f.wallSeconds},
               {"milliseconds_per_step", f.millisecondsPerStep()},
               {"stages", toJson(f.stages)},
               {"mean_density_error", f.meanDensityError},
               {"max_density_error", f.maxDensityError},
               {"density_iterations", f.meanDensityIterations},
               {"divergence_iterations", f.meanDivergenceIterations},
               {"mean_divergence", f.flow.meanDivergence},
               {"max_divergence", f.flow.maxDivergence},
               {"kinetic_energy", f.flow.kineticEnergy},
               {"potential_energy", f.flow.potentialEnergy},
               {"momentum_drift", f.flow.momentumDrift}};
  if (f.files) json["files"] = *f.files;
  std::printf("%s\n", json.dump().c_str());
}

/// The scene's run from its initial state, or one that was saved.
ResumedRun openRun(const SimulateOptions& options) {
  const SceneOptions& scene = options.scene;
  if (options.resume.empty()) {
    if (scene.scene.empty()) throw core::InputError("", "SCENE", "is missing; or --resume FILE");
    ResumedRun run{scene.load(), nullptr};
    run.source = openSource(run.live.scene, scene.threads);
    return run;
  }
  if (!scene.scene.empty() || !scene.assignments.empty() || scene.seed) {
    throw core::InputError("", "--resume", "takes no SCENE, --set or --seed: the state has its scene");
  }
  return resumeState(options.resume, scene.threads);
}

/// What would come to light only when the run is over and its result lost.
void checkCanBeSaved(const SimulateOptions& options, const ResumedRun& run) {
  if (options.save.empty()) return;
  if (!run.live.scene.has_simulation()) {
    throw core::InputError("", "--save", "only the state of a simulation can be saved");
  }
  const std::filesystem::path folder = std::filesystem::absolute(options.save).parent_path();
  if (!std::filesystem::is_directory(folder)) throw core::InputError(folder.string(), "--save", "is no folder");
}

void checkEnd(double until, double start) {
  if (until >= start) return;
  throw core::InputError("", "--until", "lies before the state's own time, " + std::to_string(start) + " s");
}

/// Writes a file for every frame up to the end, if there is to be one, and goes on to the end.
void advance(MeasuredRun& run, core::ParticleSource& source, FrameExport* frames, double until) {
  if (frames != nullptr) {
    // The frame after the end counts too: steps do not depend on where a run ends and another goes on from.
    source.stopAt(frames->nextSeconds());
    while (frames->nextSeconds() <= until && run.advanceTo(frames->nextSeconds())) {
      frames->write(source);
      source.stopAt(frames->nextSeconds());
    }
  }
  run.advanceTo(until);
}

int simulate(const SimulateOptions& options) {
  const ResumedRun opened = openRun(options);
  core::ParticleSource& source = *opened.source;
  checkCanBeSaved(options, opened);
  checkEnd(options.until, source.time());
  std::optional<FrameExport> frames;
  if (!options.out.empty()) frames.emplace(options.out, options.format, options.framesPerSecond, source.time());

  MeasuredRun run(source);
  advance(run, source, frames ? &*frames : nullptr, options.until);
  Figures figures = run.figures();
  if (frames) figures.files = frames->written();
  options.scene.json ? printJson(figures) : printText(figures);
  if (!source.halted().empty()) throw core::EnvironmentError("the simulation halted: " + source.halted());
  if (!options.save.empty()) saveState(options.save, opened.live.scene, source);
  return 0;
}

}  // namespace

void addSimulateCommand(CLI::App& program, Command& chosen) {
  const auto options = std::make_shared<SimulateOptions>();
  CLI::App& verb =
      *program.add_subcommand("simulate", "Run a scene without drawing, print what it cost, and write its particles");
  addSceneOptions(verb, options->scene, "", true);
  verb.get_option("SCENE")->required(false);
  verb.add_option("--until", options->until, "Simulated time to stop at, s")
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str();
  verb.add_option("--out", options->out, "Folder for the particles of every frame: frame_0000.bgeo, …");
  verb.add_option("--format", options->format, "Of the files in --out")
      ->check(CLI::IsMember(FrameExport::formats()))
      ->capture_default_str();
  verb.add_option("--fps", options->framesPerSecond, "Files per simulated second, with --out")
      ->check(CLI::Range(0.01, 10000.0))
      ->capture_default_str();
  verb.add_option("--save", options->save, "File for the state at the end, from which --resume goes on");
  verb.add_option("--resume", options->resume, "Go on from a state that --save has written, instead of SCENE");
  verb.callback([options, &chosen] { chosen = [options] { return simulate(*options); }; });
}

}  // namespace sluice::app
