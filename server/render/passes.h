#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "composite_variant.h"
#include "frame_context.h"
#include "kept_light_map.h"
#include "noise_programs.h"
#include "noise_raster.h"
#include "sluice/render/fluid_renderer.h"
#include "smoothing/smoothing_method.h"
#include "splat_target.h"
#include "thickness_smoothing.h"
#include "tone_curve.h"

namespace sluice::render {

// One class per pass, each in the file of its name. They live on the thread of the context.

class BackgroundPass {
 public:
  BackgroundPass();
  void run(const FrameContext& frame);

 private:
  void useFloor(bool bodies, bool lamps);

  gl::Program sky_;
  std::map<std::pair<bool, bool>, gl::Program> floors_;  ///< By whether bodies shade it, and lamps light it.
};

/// Copies the background into the scene and puts the sunlight right that meets floor and bodies behind liquid.
class SunlightPass {
 public:
  void run(const FrameContext& frame, const KeptLightMap& light);

 private:
  void upload(const LightMap& map);

  std::optional<gl::Program> onFloor_;
  std::optional<gl::Program> onBodies_;
  gl::Texture texture_;
  core::ImageSize size_;
  std::uint64_t version_ = 0;  ///< Of the map in the texture.
};

/// Splats the depth of the particles' spheres, or what the look has instead: points on the CPU where that is what draws
/// anyway.
class SplatsPass {
 public:
  void runPoints(const FrameContext& frame);
  void runLarge(const FrameContext& frame);

 private:
  SplatPrograms programs_{"splats.frag"};
};

/// Sums the particles' chords along every line of sight; points likewise.
class ThicknessPass {
 public:
  void runPoints(const FrameContext& frame);
  void runLarge(const FrameContext& frame);

 private:
  SplatPrograms programs_{"thickness.frag"};
};

/// Evens the thickness out over as wide a place as it is told, whatever the distance.
class SmoothThicknessPass {
 public:
  SmoothThicknessPass();
  void run(const FrameContext& frame);

 private:
  ThicknessSmoothing cpu_;
  gl::Program program_;
};

/// Marks where there is liquid in the stencil.
class MaskPass {
 public:
  MaskPass();
  void run(const FrameContext& frame);
  /// Of several liquids: writes how many others are behind each pixel.
  void runLayers(const FrameContext& frame);

 private:
  /// Liquid behind bodies.
  void takeOutHidden(const FrameContext& frame);

  gl::Program program_;
  std::optional<gl::Program> hidden_;
  std::optional<gl::Program> layers_;
};

/// The farthest side of the liquid's splats.
class BackSplatsPass {
 public:
  void run(const FrameContext& frame);

 private:
  void draw(const FrameContext& frame, Resource depth, bool large);

  SplatPrograms programs_{"back_splats.frag"};
  std::optional<gl::Program> invert_;
};

/// Whatever method the look chooses; each is made when it is first used.
class SmoothingPass {
 public:
  void run(const FrameContext& frame);
  /// The same for the back of the liquid.
  void runOnBack(const FrameContext& frame);

 private:
  std::map<v1::Smoothing::MethodCase, std::unique_ptr<SmoothingMethod>> methods_;
};

/// Noise that goes with the particles, over the smoothed surface [vdL09, section 3.4], and how violent they are.
class NoisePass {
 public:
  void run(const FrameContext& frame);

 private:
  void drawOnDevice(const FrameContext& frame, std::span<const NoiseSprite> sprites, float fallOff);

  NoiseRaster raster_;
  std::optional<NoisePrograms> onDevice_;
};

/// The liquid over the scene, or where it is coarser than the picture, by itself.
class CompositePass {
 public:
  void run(const FrameContext& frame);

 private:
  std::map<CompositeVariant, gl::Program> programs_;
};

/// Liquid that is coarser than the picture over the scene: interpolated as shaded colour and coverage, never as depth,
/// so that silhouettes are soft (van der Laan et al. 2009, section 3.5.1).
class BlendLiquidPass {
 public:
  BlendLiquidPass();
  void run(const FrameContext& frame) const;

 private:
  gl::Program program_;
};

/// Drops of spray over the picture, hidden where liquid is nearer.
class SprayPass {
 public:
  void run(const FrameContext& frame);

 private:
  std::map<std::vector<std::string_view>, gl::Program> programs_;  ///< By what may hide it.
};

/// Adds up the optical depth of spray, foam and bubbles: on the CPU where that is what draws anyway.
class FoamPass {
 public:
  FoamPass();
  void run(const FrameContext& frame);

 private:
  std::optional<gl::Program> program_;
  gl::StreamBuffer buffer_;
  gl::VertexArray array_;
};

/// Foam over the picture.
class BlendFoamPass {
 public:
  BlendFoamPass();
  void run(const FrameContext& frame) const;

 private:
  gl::Program program_;
};

/// From the picture's light to what a screen shows.
class ToneMapPass {
 public:
  /// 8-bit sRGB, RGBA, row by row from the top.
  std::vector<std::uint8_t> run(const FrameContext& frame);

 private:
  std::optional<ToneTable> table_;
  v1::Tone toneOf_;
  std::vector<std::uint16_t> radiance_;
  std::map<std::string_view, gl::Program> programs_;
};

/// Binds the surfaces of the frame's other liquids for layers.glsl.
void bindOtherSurfaces(const FrameContext& frame, const gl::Program& program);

/// Binds noise and violence for surface_noise.glsl, and what it has to know of them.
void bindNoise(const FrameContext& frame, const gl::Program& program);

/// The scene under the liquid: in the sunlight that the liquid lets through.
Resource sceneOf(const FrameContext& frame);

}  // namespace sluice::render
