#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "frame_context.h"

namespace sluice::render {

/// Facts about the surface that is to be smoothed.
struct SurfaceTraits {
  double spacing = 1;        ///< d, m.
  double splatRadius = 1;    ///< R, m.
  double nearestDepth = 1;   ///< Least eye depth of the liquid's surface, m.
  double pixelSlope = 1e-3;  ///< Width of one of the surface's pixels at eye depth 1.
  core::ImageSize size;      ///< Of the surface, not of the picture.
  DeviceTraits device;
};

/// What a method asks of a frame, besides the surface.
struct SmoothingPlan {
  std::size_t scratch = 0;  ///< How many of kSurfaceScratch it draws into.
  bool mask = false;        ///< Draws where the stencil says that there is liquid.
  bool erodes = false;      ///< Leaves less liquid than there was: the mask has to be drawn again.
  /// Asks for splats whose limbs are flat: the surface of a splat ends at its rim up to a radius behind its front, far
  /// deeper than where splats meet inside the liquid, and silhouettes would show every single one.
  bool flatRims = false;
  int sweeps = 1;  ///< Times that it goes over the whole surface, along rows and along columns counted apart.
  FlowSchedule flow = {};
  std::vector<core::LeftOut> leftOut = {};
};

/// One way to smooth the surface. Lives on the thread of the context.
class SmoothingMethod {
 public:
  virtual ~SmoothingMethod() = default;

  /// Leaves the smoothed surface in Resource::Surface. Runs with the surface's uniforms bound.
  virtual void run(const FrameContext& frame) = 0;
};

/// Everything the rest of the renderer knows of a method. `plan` is pure and needs no GL.
struct SmoothingMethodEntry {
  v1::Smoothing::MethodCase method;
  SmoothingPlan (*plan)(const v1::Smoothing& smoothing, const SurfaceTraits& traits);
  std::unique_ptr<SmoothingMethod> (*make)();
};

/// Every method of the oneof Smoothing.method.
std::span<const SmoothingMethodEntry> smoothingMethods();

/// The chosen method's entry; null when none is chosen.
const SmoothingMethodEntry* findSmoothingMethod(v1::Smoothing::MethodCase method);

/// The name of the oneof's member, with spaces: "implicit curvature flow".
std::string smoothingName(v1::Smoothing::MethodCase method);

/// The Gaussian's σ that smooths as much as `smoothing.time`: √T, m.
double smoothingDeviation(const v1::Smoothing& smoothing, double spacing);

// Each method stands in the file of its name.
SmoothingPlan planBilateral(const v1::Smoothing& smoothing, const SurfaceTraits& traits);
std::unique_ptr<SmoothingMethod> makeBilateral();
SmoothingPlan planBinomial(const v1::Smoothing& smoothing, const SurfaceTraits& traits);
std::unique_ptr<SmoothingMethod> makeBinomial();
SmoothingPlan planCurvatureFlow(const v1::Smoothing& smoothing, const SurfaceTraits& traits);
std::unique_ptr<SmoothingMethod> makeCurvatureFlow();
SmoothingPlan planCurvatureFlowVanDerLaan2009(const v1::Smoothing& smoothing, const SurfaceTraits& traits);
std::unique_ptr<SmoothingMethod> makeCurvatureFlowVanDerLaan2009();
SmoothingPlan planFullBilateral(const v1::Smoothing& smoothing, const SurfaceTraits& traits);
std::unique_ptr<SmoothingMethod> makeFullBilateral();
SmoothingPlan planGaussian(const v1::Smoothing& smoothing, const SurfaceTraits& traits);
std::unique_ptr<SmoothingMethod> makeGaussian();
SmoothingPlan planImplicitCurvatureFlow(const v1::Smoothing& smoothing, const SurfaceTraits& traits);
std::unique_ptr<SmoothingMethod> makeImplicitCurvatureFlow();
SmoothingPlan planNarrowRange(const v1::Smoothing& smoothing, const SurfaceTraits& traits);
std::unique_ptr<SmoothingMethod> makeNarrowRange();
SmoothingPlan planPlaneFit(const v1::Smoothing& smoothing, const SurfaceTraits& traits);
std::unique_ptr<SmoothingMethod> makePlaneFit();
SmoothingPlan planRklCurvatureFlow(const v1::Smoothing& smoothing, const SurfaceTraits& traits);
std::unique_ptr<SmoothingMethod> makeRklCurvatureFlow();

}  // namespace sluice::render
