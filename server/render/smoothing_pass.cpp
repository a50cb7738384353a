#include "passes.h"
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
  FrameContext back = frame;
  back.targets = frame.targets.withSurface(Resource::BackSurface);
  run(back);
}

}  // namespace sluice::render
