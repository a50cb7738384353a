#include "smoothing/paper_tables.h"

#include <algorithm>
#include <array>
#include <map>
#include <memory>

#include "sluice/scene/convert.h"
#include "sluice/sources/column_and_sheet.h"
#include "smoothing/measure.h"
#include "smoothing/methods.h"
#include "study_scene.h"

namespace sluice::evaluate {

namespace {

constexpr const char* kPaperMachine = "GeForce 8800 GTS, 2009";

/// A line of a table: a method's family, its number of iterations, and the paper's ms per frame.
struct PaperLine {
  int table;
  const char* dataset;
  const char* setting;
  bool bilateral;
  int iterations;
  int divisor;
  double paperMilliseconds;
};

// Table 1 for both of its data sets, without its line on foam; Table 2, where the paper names no count for the flow:
// that line is in Table 1's terms, at quarter resolution.
constexpr auto kLines = std::to_array<PaperLine>({
    {1, "corridor", "bilateral Gaussian", true, 1, 1, 18.1},
    {1, "corridor", "curvature flow, quarter resolution, 15 iterations", false, 15, 4, 17.5},
    {1, "corridor", "curvature flow, half resolution, 40 iterations", false, 40, 2, 19.6},
    {1, "corridor", "curvature flow, full resolution, 100 iterations", false, 100, 1, 50.0},
    {1, "logo", "bilateral Gaussian", true, 1, 1, 22.7},
    {1, "logo", "curvature flow, quarter resolution, 15 iterations", false, 15, 4, 23.3},
    {1, "logo", "curvature flow, half resolution, 40 iterations", false, 40, 2, 28.6},
    {1, "logo", "curvature flow, full resolution, 100 iterations", false, 100, 1, 50.0},
    {2, "close-up", "curvature flow", false, 15, 4, 27.8},
    {2, "close-up", "bilateral Gaussian, 1 iteration", true, 1, 1, 25.6},
    {2, "close-up", "bilateral Gaussian, 2 iterations", true, 2, 1, 31.3},
    {2, "close-up", "bilateral Gaussian, 4 iterations", true, 4, 1, 38.5},
    {2, "close-up", "bilateral Gaussian, 6 iterations", true, 6, 1, 47.6},
});

class TableStudy {
 public:
  TableStudy(render::FluidRenderer& renderer, const Options& options, const std::string& machine,
             std::vector<std::string>& notes)
      : renderer_(renderer),
        machine_(machine),
        notes_(notes),
        scene_(shippedScene(options, "column_and_sheet")),
        particles_(sources::openColumnAndSheet(scene_)->snapshot()),
        frames_(options.quick ? 5 : 11) {
    particles_->sequence = 1;  // the same particles in every frame: they are uploaded once
  }

  std::vector<Row> run() {
    for (const PaperLine& line : kLines) {
      for (const std::string& method : methodsOf(line)) addLine(line, method);
    }
    Row ours = measure("ours, the default look", scene_.look(), defaultMethod());
    ours.set("table", std::int64_t{0});
    rows_.push_back(std::move(ours));
    return std::move(rows_);
  }

 private:
  /// The schema's methods of a line's family. The flow as printed comes before the flow in inverse depth.
  static std::vector<std::string> methodsOf(const PaperLine& line) {
    std::vector<std::string> names;
    for (const SmoothingMethod& method : smoothingMethods()) {
      const bool isFlow = method.name == "curvature_flow_vanderlaan2009" || method.name == "curvature_flow";
      if (line.bilateral ? method.name == "bilateral" : isFlow) names.push_back(method.name);
    }
    std::ranges::sort(names, std::greater<>());
    return names;
  }

  static SmoothingMethod defaultMethod() {
    const std::vector<SmoothingMethod> methods = smoothingMethods();
    return *std::ranges::find(methods, true, &SmoothingMethod::isDefault);
  }

  void addLine(const PaperLine& line, const std::string& method) {
    const auto skip = [&](const std::string& what) {
      notes_.push_back("table " + std::to_string(line.table) + ", " + line.setting + ": " + method + " has no " + what);
    };
    const std::vector<int> divisors = smoothingDivisors();
    if (std::ranges::find(divisors, line.divisor) == divisors.end()) {
      return skip("1/" + std::to_string(line.divisor) + " resolution");
    }
    v1::Look look = scene_.look();
    v1::Smoothing& smoothing = *look.mutable_smoothing();
    chooseMethod(smoothing, method);
    setSmoothingDivisor(smoothing, line.divisor);
    google::protobuf::Message& parameters = chosenMethod(smoothing);
    if (line.bilateral) {
      if (!setField(parameters, "iterations", line.iterations) && line.iterations > 1) return skip("iterations");
    } else {
      // More smoothing than the iterations reach, so that they are all taken.
      smoothing.set_time(largestAllowed(smoothing, "time"));
      if (!setField(parameters, "max_iterations", line.iterations)) return skip("max_iterations");
    }
    const Row measured = measure(line.setting, look, {method, false});
    if (measured.number("iterations_run") == 0) {
      const std::string note = "the renderer does not run " + method;
      if (std::ranges::find(notes_, note) == notes_.end()) notes_.push_back(note);
      return;
    }
    Row row{{"table", std::int64_t{line.table}},
            {"dataset", std::string(line.dataset)},
            {"paper_milliseconds", line.paperMilliseconds},
            {"paper_machine", std::string(kPaperMachine)}};
    for (const auto& [key, value] : measured.cells()) row.set(key, value);
    rows_.push_back(std::move(row));
  }

  Row measure(const std::string& setting, const v1::Look& look, const SmoothingMethod& method) {
    v1::Scene drawn = scene_;
    *drawn.mutable_look() = look;
    const Setting picture{std::move(drawn), scene::toCamera(scene_.camera()), {1024, 768}};
    // The paper's scenes share settings, which are measured once.
    const std::string key = look.SerializeAsString();
    const auto known = measured_.find(key);
    const MeasuredFrames frames = known != measured_.end()
                                      ? known->second
                                      : measureFrames(renderer_, *particles_, picture, method.stage(), frames_);
    measured_[key] = frames;
    return {{"setting", setting},
            {"method", method.name},
            {"iterations_run", frames.sweeps},
            {"frame_milliseconds_median", frames.frameMilliseconds},
            {"smoothing_milliseconds_median", frames.stageMilliseconds},
            {"particles", static_cast<std::int64_t>(particles_->size())},
            {"machine", machine_}};
  }

  render::FluidRenderer& renderer_;
  const std::string& machine_;
  std::vector<std::string>& notes_;
  v1::Scene scene_;
  std::unique_ptr<core::ParticleSnapshot> particles_;
  int frames_;
  std::map<std::string, MeasuredFrames> measured_;  ///< By the look.
  std::vector<Row> rows_;
};

}  // namespace

std::vector<Row> paperTableRows(render::FluidRenderer& renderer, const Options& options, const std::string& machine,
                                std::vector<std::string>& notes) {
  return TableStudy(renderer, options, machine, notes).run();
}

}  // namespace sluice::evaluate
