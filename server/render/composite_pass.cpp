#include "passes.h"

namespace sluice::render {

std::vector<std::string_view> CompositeVariant::defines() const {
  std::vector<std::string_view> names;
  if (opaque) names.emplace_back("OPAQUE");
  if (specular) names.emplace_back("SPECULAR");
  if (normals) names.emplace_back("NORMALS");
  if (layered) names.emplace_back("LAYERED");
  return names;
}

Resource sceneOf(const FrameContext& frame) {
  const bool changed = frame.plan.runs(Pass::GroundShadow) || frame.plan.runs(Pass::GlassBehind) || frame.layer > 0;
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
  const CompositeVariant variant{frame.look.liquid().opaque(), frame.look.liquid().physical().specular() > 0,
                                 frame.scene.view().has_normals(), frame.plan.layers > 1};
  auto program = programs_.find(variant);
  if (program == programs_.end()) {
    program = programs_.emplace(variant, shaders().program("picture.vert", "composite.frag", variant.defines())).first;
  }

  const Resource scene = sceneOf(frame);
  const bool coarse = frame.plan.runs(Pass::BlendLiquid, frame.liquid);
  const Resource into = coarse ? Resource::Liquid : Resource::Picture;
  if (coarse) frame.targets.clear(into);
  beginTarget(frame, into);
  keepToLiquid();
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  // Colours come multiplied by their coverage.
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  bindTexture(frame, 0, Resource::Surface);
  bindTexture(frame, 1, scene);
  if (!variant.opaque) bindTexture(frame, 2, Resource::Thickness);
  if (variant.layered) bindOtherSurfaces(frame, program->second);
  glUseProgram(program->second.name());
  drawPicture();
}

}  // namespace sluice::render
