#include <span>

#include "composite_variant.h"
#include "planner.h"
#include "smoothing/smoothing_method.h"

namespace sluice::render {

void Planner::planBackSurface() {
  if (refractionOf(look().liquid()) != Refraction::TwoInterfaces) {
    const char* const reason =
        isOpaque(look().liquid()) ? "the liquid is opaque" : "look.liquid.two_interfaces is not chosen";
    leaveOut(Pass::BackSplats, reason);
    return;
  }
  allocate(Resource::BackSurface, PixelFormat::R32f, surfaceSize());
  std::vector<Resource> writes{Resource::BackSurface};
  if (!plan_.device.software) {
    allocate(Resource::BackDepth, PixelFormat::R32f, surfaceSize());
    writes.push_back(Resource::BackDepth);
  }
  run(Pass::BackSplats, {Resource::Particles, Resource::SplatList}, writes);

  // As the front is smoothed, in the same buffers besides.
  const auto smoothing = std::ranges::find_if(
      plan_.steps, [&](const PassStep& step) { return step.pass == Pass::Smoothing && step.liquid == liquid_; });
  if (smoothing == plan_.steps.end()) {
    leaveOut(Pass::BackSmoothing, "the front is not smoothed");
    return;
  }
  std::vector<Resource> buffers{Resource::BackSurface};
  for (const Resource scratch : kSurfaceScratch) {
    if (plan_.buffer(id(scratch)) != nullptr) buffers.push_back(scratch);
  }
  std::vector<Resource> reads{Resource::BackSurface};
  if (plan_.runs(Pass::Mask, liquid_)) reads.push_back(Resource::Stencil);
  const int sweeps = smoothing->sweeps;
  run(Pass::BackSmoothing, std::string(name(Pass::BackSmoothing)), reads, buffers, sweeps);
}

}  // namespace sluice::render
