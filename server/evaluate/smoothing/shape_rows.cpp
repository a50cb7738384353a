#include "smoothing/shape_rows.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "metrics/surface_error.h"
#include "sluice/core/check.h"
#include "smoothing/measure.h"
#include "smoothing/methods.h"
#include "study_scene.h"

namespace sluice::evaluate {

namespace {

/// The splats of published comparisons, so that their tables can stand beside ours. Opaque: thickness is not in
/// question.
constexpr const char* kScene =
    "column_and_sheet {} look { splats { radius_in_spacings: 0.8 } liquid { opaque: true } } background { floor: false "
    "}";

/// Depth steps from 3 splat radii on are edges, as the methods' own defaults have it.
constexpr double kEdgeRadii = 3;

class ShapeStudy {
 public:
  ShapeStudy(render::FluidRenderer& renderer, const Subject& subject, const Sweep& sweep, const Options& options,
             std::vector<std::string>& notes)
      : renderer_(renderer), subject_(subject), sweep_(sweep), notes_(notes), scene_(studyScene(options, kScene)) {}

  std::vector<Row> run() {
    for (const int divisor : sweep_.divisors) {
      const Reference reference = makeReference(divisor);
      v1::Smoothing raw = scene_.look().smoothing();
      raw.set_time(0);
      addRow({"none", false}, raw, divisor, reference);
      for (const SmoothingMethod& method : smoothingMethods()) addRows(method, divisor, reference);
    }
    return std::move(rows_);
  }

 private:
  Setting setting(const v1::Smoothing& smoothing, int divisor) const {
    Setting setting{scene_, subject_.camera, sweep_.size};
    *setting.scene.mutable_look()->mutable_smoothing() = smoothing;
    setSmoothingDivisor(*setting.scene.mutable_look()->mutable_smoothing(), divisor);
    return setting;
  }

  /// Where the whole picture holds liquid; traced once.
  const Mask& pictureLiquid() {
    if (!pictureLiquid_) {
      pictureLiquid_ = traceReference(*subject_.surface, makeSight(subject_.camera, sweep_.size)).liquid;
    }
    return *pictureLiquid_;
  }

  Reference makeReference(int divisor) {
    const core::ImageSize size{(sweep_.size.width + divisor - 1) / divisor,
                               (sweep_.size.height + divisor - 1) / divisor};
    Reference reference;
    reference.divisor = divisor;
    reference.spacing = subject_.particles.spacing;
    reference.edge = kEdgeRadii * scene_.look().splats().radius_in_spacings() * reference.spacing;
    reference.surface = traceReference(*subject_.surface, makeSight(subject_.camera, size));
    reference.interior = reference.surface.interior((kJudgedMargin + divisor - 1) / divisor, reference.edge);
    reference.pictureLiquid = divisor == 1 ? reference.surface.liquid : pictureLiquid();
    if (divisor == 1) pictureLiquid_ = reference.surface.liquid;
    return reference;
  }

  void addRows(const SmoothingMethod& method, int divisor, const Reference& reference) {
    double lastMilliseconds = 0;
    double lastStrength = 1;
    for (const double strength : sweep_.strengths) {
      // Work grows with T at most linearly: by that a case is known to be too long before it has run.
      const double expected = lastMilliseconds * std::max(1.0, strength / lastStrength);
      if (expected > sweep_.longestMilliseconds) {
        notes_.push_back(subject_.name + ": " + method.name + " from T = " + shortText(strength) + " d² on, at 1/" +
                         std::to_string(divisor) + " of the resolution, is left out: a frame would take " +
                         shortText(std::round(expected)) + " ms and more");
        break;
      }
      v1::Smoothing smoothing = scene_.look().smoothing();
      chooseMethod(smoothing, method.name);
      smoothing.set_time(strength);
      // An explicit flow takes the steps that T needs; what it costs is what the study is about.
      google::protobuf::Message& parameters = chosenMethod(smoothing);
      setField(parameters, "max_iterations", largestAllowed(parameters, "max_iterations"));
      lastMilliseconds = addRow(method, smoothing, divisor, reference);
      if (lastMilliseconds == 0) break;
      lastStrength = strength;
    }
  }

  /// Returns the time of a frame; 0, and adds no row, where the renderer has no such method.
  double addRow(const SmoothingMethod& method, const v1::Smoothing& smoothing, int divisor,
                const Reference& reference) {
    const MeasuredSurface measured =
        measureSurface(renderer_, subject_.particles, setting(smoothing, divisor), method.stage());
    if (smoothing.time() > 0 && measured.sweeps == 0) {
      const std::string note = "the renderer does not run " + method.name;
      if (std::ranges::find(notes_, note) == notes_.end()) notes_.push_back(note);
      return 0;
    }
    SLUICE_CHECK(measured.q.size == reference.surface.sight.size);
    const SurfaceGeometry geometry = geometryOf(measured.q.values, reference.surface.sight, reference.edge);
    const SurfaceError error = compareSurface(measured.q.values, geometry, reference);
    const Sight turnedSight = makeSight(turned(subject_.camera, kTurnDegrees), measured.turnedQ.size);
    const SurfaceGeometry turnedGeometry = geometryOf(measured.turnedQ.values, turnedSight, reference.edge);
    const double flicker =
        flickerDegrees(measured.q.values, geometry, reference, measured.turnedQ.values, turnedGeometry, turnedSight);
    const bool isDefault =
        method.isDefault && smoothing.time() == defaultSmoothingTime() && divisor == defaultSmoothingDivisor();
    rows_.push_back({{"shape", subject_.name},
                     {"method", method.name},
                     {"is_default", isDefault},
                     {"strength", smoothing.time()},
                     {"scale", 1.0 / divisor},
                     {"milliseconds_median", measured.stageMilliseconds},
                     {"passes", measured.sweeps},
                     {"depth_rmse_spacings", error.depthRmseSpacings},
                     {"depth_rmse_unbiased_spacings", error.depthRmseUnbiasedSpacings},
                     {"normal_error_mean_deg", error.normalMeanDegrees},
                     {"normal_error_rms_deg", error.normalRmsDegrees},
                     {"normal_error_p95_deg", error.normalP95Degrees},
                     {"silhouette_iou", error.silhouetteIou},
                     {"hausdorff_px", error.hausdorffPixels},
                     {"curvature_residual", error.curvatureResidual},
                     {"holes", static_cast<std::int64_t>(error.holes)},
                     {"flicker", flicker},
                     {"frame_milliseconds_median", measured.frameMilliseconds}});
    return measured.frameMilliseconds;
  }

  render::FluidRenderer& renderer_;
  const Subject& subject_;
  const Sweep& sweep_;
  std::vector<std::string>& notes_;
  v1::Scene scene_;
  std::optional<Mask> pictureLiquid_;
  std::vector<Row> rows_;
};

}  // namespace

Sweep smoothingSweep(bool quick) {
  Sweep sweep;
  sweep.size = quick ? core::ImageSize{256, 256} : core::ImageSize{512, 512};
  sweep.strengths = quick ? std::vector<double>{1} : std::vector<double>{0.5, 1, 2, 4, 8};
  for (const int divisor : smoothingDivisors()) {
    if (!quick || divisor <= 2) sweep.divisors.push_back(divisor);
  }
  // So that the whole study ends within its minute, or its twenty.
  sweep.longestMilliseconds = quick ? 200 : 2500;
  const auto include = [](auto& values, auto value) {
    if (std::ranges::find(values, value) == values.end()) values.push_back(value);
    std::ranges::sort(values);
  };
  include(sweep.strengths, defaultSmoothingTime());
  include(sweep.divisors, defaultSmoothingDivisor());
  return sweep;
}

std::vector<Row> smoothingRows(render::FluidRenderer& renderer, const Subject& subject, const Sweep& sweep,
                               const Options& options, std::vector<std::string>& notes) {
  return ShapeStudy(renderer, subject, sweep, options, notes).run();
}

}  // namespace sluice::evaluate
