#include <array>

#include "body_passes.h"
#include "passes.h"

namespace sluice::render {

namespace {

/// Of an antialiased silhouette; what software GL has, and every GPU.
constexpr GLsizei kSamples = 4;

gl::Texture makeSamples(GLenum format, core::ImageSize size) {
  GLuint name = 0;
  glCreateTextures(GL_TEXTURE_2D_MULTISAMPLE, 1, &name);
  gl::Texture texture(name);
  glTextureStorage2DMultisample(name, kSamples, format, size.width, size.height, GL_TRUE);
  return texture;
}

}  // namespace

std::set<std::string_view> liquidFrontDefines(const FrameContext& frame) {
  std::set<std::string_view> defines;
  const bool hasLiquid = frame.plan.runs(Pass::Composite, frame.liquid);
  if (hasLiquid) defines.insert("LIQUID");
  if (frame.plan.layers > 1 || (!hasLiquid && frame.plan.runs(Pass::Composite))) defines.insert("LAYERED");
  if (frame.plan.buffer(Resource::SceneDepth) != nullptr) defines.insert("BODIES");
  return defines;
}

void bindLiquidFront(const FrameContext& frame, const gl::Program& program) {
  const std::set<std::string_view> defines = liquidFrontDefines(frame);
  if (defines.contains("LIQUID")) bindTexture(frame, 0, Resource::Surface);
  if (defines.contains("LAYERED")) bindOtherSurfaces(frame, program);
  if (defines.contains("BODIES")) bindTexture(frame, 7, Resource::SceneDepth);
}

void BodiesPass::fit(core::ImageSize size) {
  if (size_ == size) return;
  size_ = size;
  light_ = makeSamples(GL_RGBA16F, size);
  depth_ = makeSamples(GL_DEPTH_COMPONENT32F, size);
  GLuint name = 0;
  glCreateFramebuffers(1, &name);
  framebuffer_ = gl::Framebuffer(name);
  glNamedFramebufferTexture(name, GL_COLOR_ATTACHMENT0, light_.name(), 0);
  glNamedFramebufferTexture(name, GL_DEPTH_ATTACHMENT, depth_.name(), 0);
}

void BodiesPass::drawSamples(const BodyScene& bodies, const ViewGeometry& view, std::span<const PixelRect> places) {
  constexpr std::array<GLfloat, 4> kNothing{};
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  for (const PixelRect& place : places) {
    const KeepTo keepTo(place);
    glClearNamedFramebufferfv(framebuffer_.name(), GL_COLOR, 0, kNothing.data());
    glClearNamedFramebufferfv(framebuffer_.name(), GL_DEPTH, 0, kNothing.data());
  }
  matte_.draw(bodies, view);
}

void BodiesPass::bindSamples() const {
  glBindTextureUnit(5, light_.name());
  glBindTextureUnit(6, depth_.name());
}

void BodiesPass::run(const FrameContext& frame, const BodyScene& bodies) {
  if (!resolve_) {
    resolve_ = shaders().program("picture.vert", "resolve_bodies.frag");
    sceneDepth_ = shaders().program("picture.vert", "scene_depth.frag");
  }
  fit(frame.view.size);
  frame.targets.clear(Resource::SceneDepth);
  if (frame.bodyPlaces.empty()) return;
  beginTarget(frame, Resource::Background);
  drawSamples(bodies, frame.view, frame.bodyPlaces);

  bindSamples();
  beginTarget(frame, Resource::Background);
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC1_ALPHA);
  glUseProgram(resolve_->name());
  drawPicture(frame.bodyPlaces);
  beginTarget(frame, Resource::SceneDepth);
  glUseProgram(sceneDepth_->name());
  drawPicture(frame.bodyPlaces);
}

void BodiesPass::runEdges(const FrameContext& frame) {
  if (frame.bodyPlaces.empty()) return;
  std::set<std::string_view> defines = liquidFrontDefines(frame);
  defines.insert("EDGES");
  auto program = edges_.find(defines);
  if (program == edges_.end()) {
    const std::vector<std::string_view> names(defines.begin(), defines.end());
    program = edges_.emplace(defines, shaders().program("picture.vert", "resolve_bodies.frag", names)).first;
  }
  bindSamples();
  beginTarget(frame, Resource::Picture);
  bindLiquidFront(frame, program->second);
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC1_ALPHA);
  glUseProgram(program->second.name());
  drawPicture(frame.bodyPlaces);
}

}  // namespace sluice::render
