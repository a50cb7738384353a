#pragma once

#include <array>
#include <map>

#include "frame_context.h"
#include "implicit_curvature_flow.h"
#include "shadow_map.h"
#include "sluice/render/fluid_renderer.h"

namespace sluice::render {

// One class per pass, each in the file of its name. They live on the thread of the context.

class BackgroundPass {
 public:
  BackgroundPass();
  void run(const FrameContext& frame) const;

 private:
  gl::Program sky_;
  gl::Program floor_;
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

/// Splats the depth of the particles' spheres.
class SplatsPass {
 public:
  SplatsPass();
  void runPoints(const FrameContext& frame) const;
  void runLarge(const FrameContext& frame) const;

 private:
  gl::Program points_;
  gl::Program large_;
};

/// Sums the particles' chords along every line of sight.
class ThicknessPass {
 public:
  ThicknessPass();
  void runPoints(const FrameContext& frame) const;
  void runLarge(const FrameContext& frame) const;

 private:
  gl::Program points_;
  gl::Program large_;
};

/// Marks where there is liquid in the stencil.
class MaskPass {
 public:
  MaskPass();
  void run(const FrameContext& frame) const;

 private:
  gl::Program program_;
};

class BilateralPass {
 public:
  BilateralPass();
  void run(const FrameContext& frame) const;

 private:
  gl::Program program_;
};

class CurvatureFlowPass {
 public:
  CurvatureFlowPass();
  void run(const FrameContext& frame) const;

 private:
  gl::Program program_;
};

/// The flow's implicit form runs on the CPU, between two GL passes: its many sweeps over a shrinking picture are
/// several times as fast there as on software GL, where reading back and uploading cost next to nothing.
class ImplicitCurvatureFlowPass {
 public:
  void run(const FrameContext& frame);

 private:
  ImplicitCurvatureFlow flow_;
  std::vector<float> inverseDepth_;
};

/// Which parts of the composite's shader a scene needs.
struct CompositeVariant {
  bool opaque = false;
  bool specular = false;
  bool normals = false;

  auto operator<=>(const CompositeVariant&) const = default;
  std::vector<std::string_view> defines() const;
};

/// The liquid over the scene.
class CompositePass {
 public:
  void run(const FrameContext& frame);
  void show(View view) { view_ = view; }

 private:
  View view_ = View::Liquid;
  std::map<CompositeVariant, gl::Program> programs_;
};

}  // namespace sluice::render
