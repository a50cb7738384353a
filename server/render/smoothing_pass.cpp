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
  if (frame.plan.buffer(Resource::SurfaceScratch) != nullptr) frame.targets.clear(Resource::SurfaceScratch);
  method->run(frame);
}

}  // namespace sluice::render
