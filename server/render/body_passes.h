#pragma once

#include <map>
#include <optional>
#include <set>
#include <string_view>

#include "body_scene.h"
#include "frame_context.h"
#include "matte_bodies.h"
#include "scene_lights.h"

namespace sluice::render {

// The passes of bodies, each in the file of its name. They live on the thread of the context.

/// Depth of the bodies as the sun sees them. Binds the map for body_shadow.glsl.
class BodyShadowPass {
 public:
  void run(const FrameContext& frame, const BodyScene& bodies);
  void bind() const;

 private:
  gl::Texture map_;
  gl::Framebuffer framebuffer_;
  std::optional<gl::Program> program_;
};

/// The bodies that are no glass, four samples a pixel, over the background, and their depth.
class BodiesPass {
 public:
  void run(const FrameContext& frame, const BodyScene& bodies);
  /// Their silhouettes over the liquid behind them.
  void runEdges(const FrameContext& frame);

 private:
  void fit(core::ImageSize size);
  void drawSamples(const BodyScene& bodies, const ViewGeometry& view, std::span<const PixelRect> places);
  void bindSamples() const;

  core::ImageSize size_;
  gl::Texture light_;
  gl::Texture depth_;
  gl::Framebuffer framebuffer_;
  MatteBodies matte_;
  std::optional<gl::Program> resolve_;
  std::optional<gl::Program> sceneDepth_;
  std::map<std::set<std::string_view>, gl::Program> edges_;
};

/// The bodies that are no glass around the liquid's middle, into its cube map.
class CubeMapPass {
 public:
  void run(const FrameContext& frame, const BodyScene& bodies);

 private:
  MatteBodies matte_{{"CUBE_MAP"}};
  gl::StreamBuffer uniforms_;
};

/// No more liquid before a body than there is room for.
class ClipThicknessPass {
 public:
  void run(const FrameContext& frame);

 private:
  std::optional<gl::Program> program_;
};

/// Thin walls of glass: those behind the liquid's front into the scene, the others over the picture.
class GlassPass {
 public:
  void runBehind(const FrameContext& frame, const BodyScene& bodies);
  void runBefore(const FrameContext& frame, const BodyScene& bodies);

 private:
  void draw(const FrameContext& frame, const BodyScene& bodies, Resource into, bool before);

  std::map<std::set<std::string_view>, gl::Program> panes_;
  std::map<std::set<std::string_view>, gl::Program> rims_;
  gl::StreamBuffer paneVertices_;
  gl::StreamBuffer rimVertices_;
};

/// The defines of liquid_front.glsl and scene_depth.glsl for this frame.
std::set<std::string_view> liquidFrontDefines(const FrameContext& frame);

/// Binds what they read.
void bindLiquidFront(const FrameContext& frame, const gl::Program& program);

}  // namespace sluice::render
