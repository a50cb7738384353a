#pragma once

#include <cstdint>
#include <vector>

#include "body_passes.h"
#include "colour_map_pass.h"
#include "legend_pass.h"
#include "passes.h"
#include "study_pass.h"

namespace sluice::render {

/// Every pass of a frame, by its name in the plan. Lives on the thread of the context.
class FramePasses {
 public:
  /// Runs one step of a plan. `Pass::SelectSplats` is not among them: the plan depends on its outcome.
  void run(Pass pass, const FrameContext& frame);

  /// What the last frame shows: 8-bit sRGB, RGBA, row by row from the top.
  std::vector<std::uint8_t> takePixels() { return std::move(pixels_); }

  /// The light that falls on the scene of the frames to come.
  void setLight(const KeptLightMap& light) { light_ = &light; }

  /// The bodies of the frames that follow, where they stand; `poses` as in core::ParticleSnapshot. Throws
  /// core::InputError where a mesh cannot be read.
  void setBodies(const v1::Scene& scene, std::span<const core::BodyPose> poses) { bodies_.update(scene, poses); }
  const BodyScene& bodies() const { return bodies_; }
  /// Lets every pass know of the lights.
  void bindLights(const v1::Scene& scene);

 private:
  BodyScene bodies_;
  gl::StreamBuffer lights_;
  BodyShadowPass bodyShadow_;
  BodiesPass bodiesPass_;
  ClipThicknessPass clipThickness_;
  CubeMapPass cubeMap_;
  GlassPass glass_;
  BackgroundPass background_;
  SunlightPass sunlight_;
  SplatsPass splats_;
  MaskPass mask_;
  SmoothingPass smoothing_;
  ThicknessPass thickness_;
  SmoothThicknessPass smoothThickness_;
  BackSplatsPass backSplats_;
  NoisePass noise_;
  CompositePass composite_;
  BlendLiquidPass blendLiquid_;
  ColourMapPass colourMap_;
  StudyPass study_;
  SprayPass spray_;
  FoamPass foam_;
  BlendFoamPass blendFoam_;
  ToneMapPass toneMap_;
  LegendPass legend_;

  const KeptLightMap* light_ = nullptr;
  std::vector<std::uint8_t> pixels_;
};

}  // namespace sluice::render
