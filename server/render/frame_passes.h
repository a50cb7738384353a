#pragma once

#include <cstdint>
#include <vector>

#include "body_passes.h"
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

  /// The bodies of the frames that follow, where they stand; `poses` as in core::ParticleSnapshot. Throws
  /// core::InputError where a mesh cannot be read.
  void setBodies(const v1::Scene& scene, std::span<const core::BodyPose> poses) { bodies_.update(scene, poses); }
  /// Counts changes of the bodies.
  std::uint64_t bodyChanges() const { return bodies_.changes(); }
  /// Lets every pass know of the lights.
  void bindLights(const v1::Scene& scene);

 private:
  BodyScene bodies_;
  gl::StreamBuffer lights_;
  BodyShadowPass bodyShadow_;
  BodiesPass bodiesPass_;
  ClipThicknessPass clipThickness_;
  GlassPass glass_;
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
