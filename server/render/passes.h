#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "frame_context.h"
#include "shadow_map.h"
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
  gl::Program sky_;
  std::map<std::pair<bool, bool>, gl::Program> floors_;  ///< By whether bodies shade it, and lamps light it.
};

/// Copies the background into the scene and darkens the floor there.
class GroundShadowPass {
 public:
  GroundShadowPass();
  /// `map` is where the shadow lies; `isNew` says that its content has changed since the last call.
  void run(const FrameContext& frame, const ShadowMap& map, bool isNew);

 private:
  gl::Program clear_;
  gl::Program opaque_;
  gl::Texture texture_;
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

 private:
  gl::Program program_;
  std::optional<gl::Program> withBodies_;
};

/// Whatever method the look chooses; each is made when it is first used.
class SmoothingPass {
 public:
  void run(const FrameContext& frame);

 private:
  std::map<v1::Smoothing::MethodCase, std::unique_ptr<SmoothingMethod>> methods_;
};

/// Which parts of the composite's shader a scene needs.
struct CompositeVariant {
  bool opaque = false;
  bool specular = false;
  bool normals = false;
  bool layered = false;

  auto operator<=>(const CompositeVariant&) const = default;
  std::vector<std::string_view> defines() const;
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

/// The scene under the liquid: with its shadow where it has one.
Resource sceneOf(const FrameContext& frame);

}  // namespace sluice::render
