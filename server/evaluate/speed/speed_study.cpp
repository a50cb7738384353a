#include "speed/speed_study.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <map>
#include <memory>
#include <sstream>
#include <thread>

#include "machine.h"
#include "scatter_plot.h"
#include "sluice/sim/simulation.h"
#include "sluice/sim/stage_cost.h"
#include "sluice/sim/step_plan.h"
#include "speed/machine_limits.h"
#include "study_scene.h"

namespace sluice::evaluate {

namespace {

constexpr const char* kSize = "size";
constexpr const char* kThreads = "threads";
constexpr const char* kRoofline = "roofline";

/// Layers of the pool: the same for every size, for deeper fluid takes the solver more iterations.
constexpr int kLayers = 20;

/// Steps after which the solver starts from pressures that hold the pool.
constexpr int kStepsToSettle = 20;

/// A pool at rest of about so many particles. Its steps are as short as those of a breaking wave, so that the solver
/// takes about as many iterations.
std::string poolText(double particles) {
  const int edge = static_cast<int>(std::lround(std::sqrt(particles / kLayers)));
  constexpr double kSpacing = 0.05;
  const double half = 0.5 * kSpacing * (edge + 1);
  std::ostringstream text;
  text << "simulation { particle_spacing: " << kSpacing << " container { min { x: " << -half << " y: 0 z: " << -half
       << " } max { x: " << half << " y: 2 z: " << half
       << " } } fluids { blocks { first_particle { x: " << -half + kSpacing << " y: " << kSpacing
       << " z: " << -half + kSpacing << " } count_x: " << edge << " count_y: " << kLayers << " count_z: " << edge
       << " } } time_step { max_seconds: 0.002 } }";
  return text.str();
}

/// Steps of one simulation, timed.
class Run {
 public:
  Run(const v1::Scene& scene, int threads) : source_(sim::makeSimulation(scene, threads)), threads_(threads) {}

  void step() {
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    source_->advance();
    milliseconds_.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
    const core::StepStatistics step = source_->statistics();
    density_.push_back(step.densityIterations);
    for (const core::StageTime& stage : step.stages) stages_[stage.name].push_back(stage.milliseconds);
    meanError_ = std::max(meanError_, step.meanDensityError);
    maxError_ = std::max(maxError_, step.maxDensityError);
  }

  /// Steps that warm up, and do not count.
  void settle(int steps) {
    for (int i = 0; i < steps; ++i) source_->advance();
  }

  double densityIterations() const { return median(density_); }
  double milliseconds() const { return median(milliseconds_); }
  double stage(const std::string& name) const {
    const auto found = stages_.find(name);
    return found == stages_.end() ? 0 : median(found->second);
  }
  const core::ParticleSource& source() const { return *source_; }

  Row row(const std::string& part) const {
    const auto particles = static_cast<double>(source_->snapshot()->size());
    double bytes = 0;
    for (const core::PlannedBuffer& buffer : source_->plan().buffers) bytes += static_cast<double>(buffer.bytes);
    const double nanoseconds = 1e6 * milliseconds() / particles;
    return {{"part", part},
            {"particles", static_cast<std::int64_t>(particles)},
            {"threads", std::int64_t{threads_}},
            {"steps", static_cast<std::int64_t>(milliseconds_.size())},
            {"milliseconds_per_step", milliseconds()},
            {"nanoseconds_per_particle", nanoseconds},
            {"density_iterations", densityIterations()},
            {"bytes_per_particle", bytes / particles},
            {"mean_density_error", meanError_},
            {"max_density_error", maxError_}};
  }

 private:
  std::unique_ptr<core::ParticleSource> source_;
  int threads_;
  std::vector<double> milliseconds_;
  std::vector<double> density_;
  std::map<std::string, std::vector<double>> stages_;
  double meanError_ = 0;
  double maxError_ = 0;
};

class SpeedStudy {
 public:
  explicit SpeedStudy(const Options& options) : options_(options) {}

  Report run() {
    const auto wants = [&](std::string_view part) { return options_.only.empty() || options_.only == part; };
    Report report;
    if (wants(kSize)) compareSizes(report);
    if (wants(kThreads)) compareThreads(report);
    report.tables.push_back(std::move(speed_));
    if (wants(kRoofline)) report.tables.push_back(roofline(report));
    return report;
  }

 private:
  v1::Scene pool(double particles) const { return studyScene(options_, poolText(particles)); }

  static int allThreads() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

  void compareSizes(Report& report) {
    PlotSeries series;
    const std::vector<double> sizes =
        options_.quick ? std::vector<double>{1e4, 3e4, 1e5} : std::vector<double>{1e4, 3e4, 1e5, 3e5, 1e6};
    for (const double particles : sizes) {
      options_.tell("speed: a pool of " + shortText(particles) + " particles");
      Run run(pool(particles), allThreads());
      run.settle(kStepsToSettle);
      const int steps = particles > 2e5 ? 5 : 15;
      for (int i = 0; i < steps; ++i) run.step();
      speed_.rows.push_back(run.row(kSize));
      const Row& row = speed_.rows.back();
      series.points.push_back({row.number("particles"), row.number("nanoseconds_per_particle"), {}});
    }
    series.name = series.label = "a pool of 20 layers";
    ScatterPlot plot;
    plot.title = "Time of a step for each particle";
    plot.xLabel = "particles";
    plot.yLabel = "ns (median)";
    plot.series.push_back(std::move(series));
    report.documents.push_back({"speed_size.svg", drawSvg(plot)});
  }

  void compareThreads(Report& report) {
    if (allThreads() < 2) {
      report.notes.push_back("threads: this machine has but one core");
      return;
    }
    options_.tell("speed: one thread and two");
    const v1::Scene scene = pool(3e4);
    std::array<Run, 2> runs{Run(scene, 1), Run(scene, 2)};
    for (Run& run : runs) run.settle(kStepsToSettle);
    // In turns, so that a busy machine slows both.
    const int rounds = options_.quick ? 15 : 40;
    for (int round = 0; round < rounds; ++round) {
      for (Run& run : runs) run.step();
    }
    for (const Run& run : runs) speed_.rows.push_back(run.row(kThreads));
    report.notes.push_back("two threads are " + shortText(runs[0].milliseconds() / runs[1].milliseconds()) +
                           " times as fast as one");
  }

  Table roofline(Report& report) {
    options_.tell("speed: stages against the machine");
    const MachineLimits limits = measureMachineLimits();
    report.notes.push_back("the machine moves " + shortText(limits.gigabytesPerSecond) + " GB/s and computes " +
                           shortText(limits.gigaflopsPerSecond) + " GFlop/s with " + std::to_string(limits.threads) +
                           " threads");
    Run run(pool(1e5), limits.threads);
    run.settle(kStepsToSettle);
    for (int i = 0; i < 15; ++i) run.step();
    const auto particles = run.source().snapshot();
    const sim::PairCounts pairs = sim::countPairs(*particles);
    core::StepStatistics step = run.source().statistics();
    step.densityIterations = static_cast<std::uint32_t>(std::lround(run.densityIterations()));
    Table table{"roofline", {}};
    for (const sim::Stage stage :
         {sim::Stage::DivergenceSolve, sim::Stage::Viscosity, sim::Stage::Gravity, sim::Stage::DensitySolve,
          sim::Stage::Move, sim::Stage::Neighbours, sim::Stage::Factors, sim::Stage::DensityError}) {
      const std::string name(sim::stageName(stage));
      const double milliseconds = run.stage(name);
      const std::optional<sim::StageCost> cost = sim::stageCost(stage, pairs, step);
      if (!cost || milliseconds <= 0) continue;
      const double perSecond = static_cast<double>(particles->size()) / milliseconds * 1e-6;
      const double ofBandwidth = cost->bytes * perSecond / limits.gigabytesPerSecond;
      const double ofPeak = cost->flops * perSecond / limits.gigaflopsPerSecond;
      table.rows.push_back({{"stage", name},
                            {"milliseconds", milliseconds},
                            {"bytes_per_particle", cost->bytes},
                            {"flops_per_particle", cost->flops},
                            {"gigabytes_per_second", cost->bytes * perSecond},
                            {"gigaflops_per_second", cost->flops * perSecond},
                            {"share_of_bandwidth", ofBandwidth},
                            {"share_of_peak", ofPeak},
                            {"nearer_to", ofBandwidth > ofPeak ? "memory" : "arithmetic"}});
    }
    return table;
  }

  const Options& options_;
  Table speed_{"speed", {}};
};

}  // namespace

std::vector<std::string> speedParts() { return {kSize, kThreads, kRoofline}; }

Report runSpeedStudy(const Options& options) { return SpeedStudy(options).run(); }

}  // namespace sluice::evaluate
