#include <algorithm>
#include <span>

#include "composite_variant.h"
#include "planner.h"
#include "smoothing/smoothing_method.h"

namespace sluice::render {

/// What is seen of the back is bent and tinted: where the CPU draws it, half the size is enough. Methods that work in
/// buffers of the surface's size, or where the stencil says, ask for a back of that size too.
bool Planner::drawsCoarseBack() const {
  const auto smoothing = smoothingStep();
  return plan_.device.software && smoothing != plan_.steps.end() && look().smoothing().divisor() == 1 &&
         smoothing->reads.size() == 1 && smoothing->writes.size() == 1;
}

std::vector<PassStep>::const_iterator Planner::smoothingStep() const {
  return std::ranges::find_if(
      plan_.steps, [&](const PassStep& step) { return step.pass == Pass::Smoothing && step.liquid == liquid_; });
}

void Planner::planBackSurface() {
  if (refractionOf(look().liquid()) != Refraction::TwoInterfaces) {
    const char* const reason =
        isOpaque(look().liquid()) ? "the liquid is opaque" : "look.liquid.two_interfaces is not chosen";
    leaveOut(Pass::BackSplats, reason);
    return;
  }
  const auto smoothing = smoothingStep();
  const bool coarse = drawsCoarseBack();
  plan_.surfaces[liquid_].backDivisor = look().smoothing().divisor() * (coarse ? 2 : 1);
  allocate(Resource::BackSurface, PixelFormat::R32f, surfaceSize());
  const Resource drawn = coarse ? Resource::BackCoarse : Resource::BackSurface;
  if (coarse) allocate(drawn, PixelFormat::R32f, dividedSize(size_, plan_.surfaces[liquid_].backDivisor));
  std::vector<Resource> writes{drawn};
  if (!plan_.device.software) {
    allocate(Resource::BackDepth, PixelFormat::R32f, surfaceSize());
    writes.push_back(Resource::BackDepth);
  }
  const int sweeps = smoothing == plan_.steps.end() ? 0 : smoothing->sweeps;
  run(Pass::BackSplats, {Resource::Particles, Resource::SplatList}, writes);

  // As the front is smoothed, in the same buffers besides.
  if (sweeps == 0) {
    leaveOut(Pass::BackSmoothing, "the front is not smoothed");
    return;
  }
  std::vector<Resource> buffers{Resource::BackSurface};
  if (coarse) buffers.push_back(drawn);
  for (const Resource scratch : kSurfaceScratch) {
    if (plan_.buffer(id(scratch)) != nullptr) buffers.push_back(scratch);
  }
  std::vector<Resource> reads{drawn};
  if (plan_.runs(Pass::Mask, liquid_)) reads.push_back(Resource::Stencil);
  run(Pass::BackSmoothing, std::string(name(Pass::BackSmoothing)), reads, buffers, sweeps);
}

}  // namespace sluice::render
