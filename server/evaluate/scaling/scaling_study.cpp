#include "scaling/scaling_study.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <memory>

#include "machine.h"
#include "metrics/sight.h"
#include "scaling/power_law.h"
#include "scatter_plot.h"
#include "sluice/gl/context.h"
#include "sluice/render/fluid_renderer.h"
#include "sluice/scene/convert.h"
#include "sluice/sources/column_and_sheet.h"
#include "smoothing/measure.h"
#include "study_scene.h"

namespace sluice::evaluate {

namespace {

constexpr const char* kParticles = "particles";
constexpr const char* kPixels = "pixels";
constexpr const char* kFrame = "frame";

/// Stages that take less of the longest frame are not fitted: their time is mostly the clock's.
constexpr double kLeastShare = 0.04;

struct Point {
  double x = 0;  ///< Particles or pixels.
  core::ImageSize size;
  std::size_t particles = 0;
  std::map<std::string, double> milliseconds;  ///< Median by stage, and of the whole frame.
};

class ScalingStudy {
 public:
  explicit ScalingStudy(const Options& options)
      : options_(options), context_(gl::Context::create()), scene_(shippedScene(options, "column_and_sheet")) {}

  Report run() {
    if (wants(kParticles)) {
      std::vector<Point> points;
      for (std::uint32_t n = 4'000; n <= 256'000; n *= options_.quick ? 4 : 2) {
        points.push_back(measure(n, {1024, 768}));
        points.back().x = n;
      }
      report(kParticles, "particles", points, "1024×768 pixels");
    }
    if (wants(kPixels)) {
      std::vector<Point> points;
      const std::vector<double> megapixels =
          options_.quick ? std::vector<double>{0.1, 0.4, 1.5, 3} : std::vector<double>{0.1, 0.2, 0.4, 0.8, 1.5, 3};
      for (const double mega : megapixels) {
        const int height = static_cast<int>(std::lround(std::sqrt(mega * 1e6 * 3 / 4)));
        points.push_back(measure(64'000, {height * 4 / 3, height}));
        points.back().x = static_cast<double>(points.back().size.width) * points.back().size.height;
      }
      report(kPixels, "pixels", points, "64,000 particles");
    }
    report_.tables.push_back(std::move(fits_));
    report_.tables.push_back(std::move(points_));
    return std::move(report_);
  }

 private:
  bool wants(std::string_view part) const { return options_.only.empty() || options_.only == part; }

  Point measure(std::uint32_t particles, core::ImageSize size) {
    options_.tell(std::to_string(particles) + " particles, " + std::to_string(size.width) + "x" +
                  std::to_string(size.height));
    scene_.mutable_column_and_sheet()->set_particles(particles);
    const std::unique_ptr<core::ParticleSnapshot> snapshot = sources::openColumnAndSheet(scene_)->snapshot();
    render::FluidRenderer renderer(*context_);
    core::Camera camera = scene::toCamera(scene_.camera());
    std::map<std::string, std::vector<double>> times;
    const int frames = options_.quick ? 5 : 11;
    for (int i = 0; i <= frames; ++i) {
      using Clock = std::chrono::steady_clock;
      camera = turned(camera, kTurnDegrees);
      snapshot->sequence = static_cast<std::uint64_t>(i) + 1;  // as from a running simulation
      const auto start = Clock::now();
      const core::Frame frame = renderer.render(*snapshot, scene_, camera, size);
      const double whole = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
      if (i == 0) continue;  // warms up
      times[kFrame].push_back(whole);
      for (const core::StageTime& stage : frame.tag.stages) times[stage.name].push_back(stage.milliseconds);
    }
    Point point;
    point.size = size;
    point.particles = snapshot->size();
    for (auto& [stage, values] : times) point.milliseconds[stage] = median(std::move(values));
    return point;
  }

  void report(const std::string& axis, const std::string& unit, const std::vector<Point>& points,
              const std::string& held) {
    ScatterPlot plot;
    plot.title = "Time of a frame against " + unit;
    plot.subtitle = held + "; " + machineName(*context_);
    plot.xLabel = unit;
    plot.yLabel = "ms (median)";
    int colour = 0;
    for (const std::string& stage : stagesToFit(points)) {
      std::vector<double> x;
      std::vector<double> y;
      PlotSeries series;
      for (const Point& point : points) {
        x.push_back(point.x);
        y.push_back(timeOf(point, stage));
        series.points.push_back({x.back(), y.back(), stage + ": " + shortText(y.back()) + " ms"});
      }
      const PowerLaw law = fitPowerLaw(x, y);
      fits_.rows.push_back({{"axis", axis},
                            {"stage", stage},
                            {"exponent", law.exponent},
                            {"exponent_standard_error", law.exponentError},
                            {"fixed_milliseconds", law.fixed},
                            {"smallest", x.front()},
                            {"largest", x.back()}});
      series.name = stage + ": exponent " + shortText(law.exponent);
      series.label = stage;
      series.colour = colour;
      series.line = false;
      PlotSeries fit;
      fit.colour = colour++;
      fit.dashed = true;
      constexpr int kSteps = 40;
      for (int i = 0; i <= kSteps; ++i) {
        const double at = x.front() * std::pow(x.back() / x.front(), static_cast<double>(i) / kSteps);
        fit.points.push_back({at, law.at(at), {}});
      }
      plot.series.push_back(std::move(fit));
      plot.series.push_back(std::move(series));
    }
    for (const Point& point : points) {
      Row row{{"axis", axis},
              {"particles", static_cast<std::int64_t>(point.particles)},
              {"width", std::int64_t{point.size.width}},
              {"height", std::int64_t{point.size.height}},
              {"frame_milliseconds_median", timeOf(point, kFrame)}};
      for (const auto& [stage, milliseconds] : point.milliseconds) {
        if (stage != kFrame) row.set(stage + "_milliseconds", milliseconds);
      }
      points_.rows.push_back(std::move(row));
    }
    report_.documents.push_back({"scaling_" + axis + ".svg", drawSvg(plot)});
  }

  static double timeOf(const Point& point, const std::string& stage) {
    const auto found = point.milliseconds.find(stage);
    return found == point.milliseconds.end() ? 0 : found->second;
  }

  /// The whole frame, then by time those stages that count and ran in every picture.
  static std::vector<std::string> stagesToFit(const std::vector<Point>& points) {
    std::vector<std::pair<double, std::string>> byTime;
    const Point& longest = points.back();
    for (const auto& [stage, milliseconds] : longest.milliseconds) {
      const bool everywhere =
          std::ranges::all_of(points, [&name = stage](const Point& p) { return timeOf(p, name) > 0; });
      if (everywhere && milliseconds >= kLeastShare * timeOf(longest, kFrame))
        byTime.emplace_back(-milliseconds, stage);
    }
    std::ranges::sort(byTime);
    std::vector<std::string> stages;
    for (const auto& [time, stage] : byTime) stages.push_back(stage);
    return stages;
  }

  const Options& options_;
  std::unique_ptr<gl::Context> context_;
  v1::Scene scene_;
  Report report_;
  Table fits_{"scaling", {}};
  Table points_{"scaling_points", {}};
};

}  // namespace

std::vector<std::string> scalingParts() { return {kParticles, kPixels}; }

Report runScalingStudy(const Options& options) { return ScalingStudy(options).run(); }

}  // namespace sluice::evaluate
