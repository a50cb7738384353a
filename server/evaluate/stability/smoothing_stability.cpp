#include "stability/smoothing_stability.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "sluice/gl/context.h"
#include "smoothing/methods.h"
#include "stability/camera_cases.h"
#include "stability/depth_cases.h"
#include "study_scene.h"

namespace sluice::evaluate {

namespace {

constexpr const char* kScene = "column_and_sheet {} look { liquid { opaque: true } } background { floor: false }";

/// Root mean square of the differences to the mean.
double roughness(const std::vector<float>& values) {
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  double sum = 0;
  for (const float v : values) sum += (v - mean) * (v - mean);
  return std::sqrt(sum / static_cast<double>(values.size()));
}

class StabilityCases {
 public:
  explicit StabilityCases(const Options& options)
      : quick_(options.quick),
        context_(gl::Context::create()),
        renderer_(*context_),
        scene_(studyScene(options, kScene)) {}

  std::vector<Row> run(const Options& options) {
    for (const SmoothingMethod& method : smoothingMethods()) {
      options.tell(method.name);
      for (const double strength : strengthsOf(method)) {
        if (!chosen(method, strength)) continue;
        runDepthCases(method, strength);
        runCameraCases(method, strength);
      }
      runStepCases(method);
    }
    return std::move(rows_);
  }

 private:
  /// Smoothing times, d². Only what is implicit promises to bear more than the schema allows, at no more work.
  std::vector<double> strengthsOf(const SmoothingMethod& method) const {
    if (method.name.find("implicit") == std::string::npos) return {defaultSmoothingTime()};
    if (quick_) return {defaultSmoothingTime(), 1e4};
    return {0.01, 1, defaultSmoothingTime(), 50, 1e3, 1e4};
  }

  /// Sets the look; false where the renderer has no such method.
  bool chosen(const SmoothingMethod& method, double strength) {
    look_ = scene_.look();
    v1::Smoothing& smoothing = *look_.mutable_smoothing();
    chooseMethod(smoothing, method.name);
    smoothing.set_time(strength);
    const CameraCase plain = cameraCases().front();
    renderer_.render(plain.particles, with(look_), plain.camera, plain.size);
    const core::Plan& plan = renderer_.plan();
    return std::ranges::find(plan.stages, method.stage(), &core::PlannedStage::name) != plan.stages.end();
  }

  void addRow(const std::string& name, const SmoothingMethod& method, double strength, const Outcome& outcome,
              double limit) {
    rows_.push_back({{"case", name},
                     {"method", method.name},
                     {"strength", strength},
                     {"outcome", outcome.text},
                     {"largest", outcome.largest},
                     {"limit", limit},
                     {"passed", outcome.passed}});
  }

  LiquidMay mayAddLiquid() const {
    const v1::Smoothing& smoothing = look_.smoothing();
    const bool closesGaps =
        smoothing.has_implicit_curvature_flow() && smoothing.implicit_curvature_flow().close_gaps_in_spacings() > 0;
    return closesGaps ? LiquidMay::FillGaps : LiquidMay::Shrink;
  }

  void runDepthCases(const SmoothingMethod& method, double strength) {
    for (const DepthCase& depthCase : depthCases()) {
      const render::FloatPicture after =
          renderer_.smooth(depthCase.surface, look_, kDepthCaseSpacing, depthCaseCamera());
      addRow(depthCase.name, method, strength, judgeSmoothed(depthCase.surface, after, mayAddLiquid()), kRangeFactor);
    }
  }

  void runCameraCases(const SmoothingMethod& method, double strength) {
    for (const CameraCase& cameraCase : cameraCases()) {
      const auto surface = [&](const v1::Look& look) {
        renderer_.render(cameraCase.particles, with(look), cameraCase.camera, cameraCase.size);
        return renderer_.readBuffer(render::Resource::Surface);
      };
      v1::Look raw = look_;
      raw.mutable_smoothing()->set_time(0);
      const render::FloatPicture before = surface(raw);
      Outcome outcome = judgeSmoothed(before, surface(look_), mayAddLiquid());
      if (before.values.empty()) outcome = {"nothing to draw", 1, true};
      addRow("camera: " + cameraCase.name, method, strength, outcome, kRangeFactor);
    }
  }

  /// Steps just within and just beyond the bound, for methods that have one. Small noise on a level surface that faces
  /// a narrow field of view, where the bound, which is the worst case over slopes and sight lines, is reached.
  void runStepCases(const SmoothingMethod& method) {
    constexpr double kIterations = 10'000;
    constexpr double kNoise = 3e-6;  // of the depth: 25 times the rounding of single precision, and far from nonlinear
    v1::Look look = scene_.look();
    v1::Smoothing& smoothing = *look.mutable_smoothing();
    chooseMethod(smoothing, method.name);
    google::protobuf::Message& parameters = chosenMethod(smoothing);
    if (!setField(parameters, "max_iterations", kIterations) || !chosen(method, defaultSmoothingTime())) return;
    // More than the iterations reach, so that all are taken, each as long as the fraction says.
    smoothing.set_time(1e9);
    const core::Camera camera{{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 5.0F};
    const render::FloatPicture noise = noisyLevel({64, 64}, kNoise);
    for (const double fraction : {0.98, 1.05}) {
      setField(parameters, "step_fraction", fraction);
      const render::FloatPicture after = renderer_.smooth(noise, look, kDepthCaseSpacing, camera);
      const std::string name =
          "noise, " + shortText(kIterations) + " steps of " + shortText(fraction) + " of the bound";
      const double growth = roughness(after.values) / roughness(noise.values);
      const bool finite = std::ranges::all_of(after.values, [](float v) { return std::isfinite(v); });
      if (fraction < 1) {
        const bool passed = finite && growth <= 1;
        addRow(name, method, smoothing.time(), {passed ? "decays" : "grows", growth, passed}, 1);
      } else {
        // Seen to grow: tenfold, which neither rounding nor chance does.
        constexpr double kSeen = 10;
        const bool grows = !finite || growth >= kSeen;
        addRow(name, method, smoothing.time(), {grows ? "grows, as it must" : "does not grow", growth, grows}, kSeen);
      }
    }
  }

  bool quick_;
  std::unique_ptr<gl::Context> context_;
  render::FluidRenderer renderer_;
  v1::Scene scene_;
  v1::Scene with(const v1::Look& look) const {
    v1::Scene scene = scene_;
    *scene.mutable_look() = look;
    return scene;
  }

  v1::Look look_;
  std::vector<Row> rows_;
};

}  // namespace

std::vector<Row> smoothingStability(const Options& options) { return StabilityCases(options).run(options); }

Outcome judgeSmoothed(const render::FloatPicture& before, const render::FloatPicture& after, LiquidMay may) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  if (after.size != before.size) return {"another size", kInfinite, false};
  double least = kInfinite;
  double most = 0;
  for (const float q : before.values) {
    if (!(q > 0)) continue;
    least = std::min<double>(least, q);
    most = std::max<double>(most, q);
  }
  double largest = 1;
  for (std::size_t i = 0; i < after.values.size(); ++i) {
    const double q = after.values[i];
    if (!std::isfinite(q)) return {"not finite", kInfinite, false};
    if (q < 0) return {"a negative depth", kInfinite, false};
    if (q == 0) continue;  // what a method does not show it may leave out
    if (may == LiquidMay::Shrink && !(before.values[i] > 0)) return {"liquid where there was none", kInfinite, false};
    largest = std::max({largest, q / most, least / q});
  }
  if (largest > kRangeFactor) return {"leaves its range", largest, false};
  return {"bounded", largest, true};
}

}  // namespace sluice::evaluate
