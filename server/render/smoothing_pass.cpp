#include "passes.h"
#include "refine_surface.h"
#include "sluice/core/check.h"

namespace sluice::render {

void SmoothingPass::run(const FrameContext& frame) {
  const v1::Smoothing::MethodCase chosen = frame.look.smoothing().method_case();
  std::unique_ptr<SmoothingMethod>& method = methods_[chosen];
  if (method == nullptr) {
    const SmoothingMethodEntry* const entry = findSmoothingMethod(chosen);
    SLUICE_CHECK(entry != nullptr);
    method = entry->make();
  }
  // Filters draw where there is liquid alone, and read what is beside it too.
  for (const Resource scratch : kSurfaceScratch) {
    if (frame.targets.has(scratch)) frame.targets.clear(scratch);
  }
  method->run(frame);
}

void SmoothingPass::runOnBack(const FrameContext& frame) {
  const bool coarse = frame.plan.buffer(Resource::BackCoarse, frame.liquid) != nullptr;
  FrameContext back = frame;
  back.targets = frame.targets.withSurface(coarse ? Resource::BackCoarse : Resource::BackSurface);
  run(back);
  if (!coarse) return;
  const float edge = 3.0F * frame.scale.radius;
  refineSurface(frame.targets.read(Resource::BackCoarse), frame.surfaceView.size, edge,
                frame.targets.startAnew(Resource::BackSurface), frame.targets.size(Resource::BackSurface));
}

}  // namespace sluice::render
