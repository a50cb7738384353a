#pragma once

#include <cstdint>
#include <vector>

#include "passes.h"

namespace sluice::render {

/// Every pass of a frame, by its name in the plan. Lives on the thread of the context.
class FramePasses {
 public:
  /// Runs one step of a plan. `Pass::SelectSplats` is not among them: the plan depends on its outcome.
  void run(Pass pass, const FrameContext& frame);

  /// What the last tone map gave: 8-bit sRGB, RGBA, row by row from the top.
  std::vector<std::uint8_t> takePixels() { return std::move(pixels_); }

  /// The shadow that the next ground shadow draws; `isNew` says that it has changed.
  void setShadow(const ShadowMap& map, bool isNew) {
    shadow_ = &map;
    newShadow_ = isNew;
  }

 private:
  BackgroundPass background_;
  GroundShadowPass groundShadow_;
  SplatsPass splats_;
  MaskPass mask_;
  SmoothingPass smoothing_;
  ThicknessPass thickness_;
  SmoothThicknessPass smoothThickness_;
  CompositePass composite_;
  BlendLiquidPass blendLiquid_;
  SprayPass spray_;
  ToneMapPass toneMap_;

  const ShadowMap* shadow_ = nullptr;
  bool newShadow_ = false;
  std::vector<std::uint8_t> pixels_;
};

}  // namespace sluice::render
