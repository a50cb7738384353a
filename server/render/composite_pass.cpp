#include "passes.h"

namespace sluice::render {

Resource sceneOf(const FrameContext& frame) {
  const bool changed = frame.plan.runs(Pass::Sunlight) || frame.plan.runs(Pass::GlassBehind) || frame.layer > 0;
  return changed ? Resource::Scene : Resource::Background;
}

void bindOtherSurfaces(const FrameContext& frame, const gl::Program& program) {
  constexpr GLuint kFirstBinding = 8;
  GLint others = 0;
  GLint before = 0;
  for (std::size_t k = 0; k < frame.plan.surfaces.size(); ++k) {
    const BufferId surface{Resource::Surface, static_cast<std::uint8_t>(k)};
    const PictureBuffer* const buffer = frame.plan.buffer(surface);
    if (k == frame.liquid || buffer == nullptr) continue;
    glBindTextureUnit(kFirstBinding + static_cast<GLuint>(others), frame.targets.texture(surface).name());
    const ViewGeometry view = divided(frame.view, lookOf(frame.scene, k).smoothing().divisor());
    glProgramUniform2f(program.name(), 24 + others, view.maxSlope.x(), view.maxSlope.y());
    if (k < frame.liquid) ++before;
    ++others;
  }
  glProgramUniform1i(program.name(), 20, others);
  glProgramUniform1i(program.name(), 21, frame.layer);
  glProgramUniform1i(program.name(), 22, before);
}

void CompositePass::run(const FrameContext& frame) {
  CompositeVariant variant = compositeVariant(frame.look.liquid(), frame.scene, frame.plan.layers > 1);
  variant.noise = frame.plan.buffer(Resource::Noise, frame.liquid) != nullptr;
  variant.whitening = frame.plan.buffer(Resource::Violence, frame.liquid) != nullptr;
  auto program = programs_.find(variant);
  if (program == programs_.end()) {
    program = programs_.emplace(variant, shaders().program("picture.vert", "composite.frag", variant.defines())).first;
  }

  const bool coarse = frame.plan.runs(Pass::BlendLiquid, frame.liquid);
  const Resource into = coarse ? Resource::Liquid : Resource::Picture;
  if (coarse) frame.targets.clear(into);
  beginTarget(frame, into);
  keepToLayer(frame.layer);
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  // Colours come multiplied by their coverage.
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  bindTexture(frame, 0, Resource::Surface);
  if (looksUpScene(variant)) bindTexture(frame, 1, sceneOf(frame));
  if (variant.bodies) bindTexture(frame, 7, Resource::SceneDepth);
  if (variant.reflection == Reflection::CubeMap) frame.cube.bind();
  if (variant.refraction != Refraction::None) bindTexture(frame, 2, Resource::Thickness);
  if (variant.refraction == Refraction::TwoInterfaces) bindTexture(frame, 3, Resource::BackSurface);
  if (variant.noise) bindNoise(frame, program->second);
  glUseProgram(program->second.name());
  drawPicture({&frame.place, 1});
}

}  // namespace sluice::render
