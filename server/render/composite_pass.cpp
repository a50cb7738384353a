#include "passes.h"

namespace sluice::render {

std::vector<std::string_view> CompositeVariant::defines() const {
  std::vector<std::string_view> names;
  if (opaque) names.emplace_back("OPAQUE");
  if (specular) names.emplace_back("SPECULAR");
  if (normals) names.emplace_back("NORMALS");
  return names;
}

Resource sceneOf(const FramePlan& plan) {
  return plan.buffer(Resource::Scene) != nullptr ? Resource::Scene : Resource::Background;
}

void CompositePass::run(const FrameContext& frame) {
  const CompositeVariant variant{frame.look.liquid().opaque(), frame.look.liquid().physical().specular() > 0,
                                 view_ == View::Normals};
  auto program = programs_.find(variant);
  if (program == programs_.end()) {
    program = programs_.emplace(variant, shaders().program("picture.vert", "composite.frag", variant.defines())).first;
  }

  const Resource scene = sceneOf(frame.plan);
  const bool coarse = frame.plan.runs(Pass::BlendLiquid);
  const Resource into = coarse ? Resource::Liquid : Resource::Picture;
  if (coarse) {
    frame.targets.clear(into);
  } else {
    copy(frame, scene, into);
  }
  beginTarget(frame, into);
  keepToLiquid();
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  // Colours come multiplied by their coverage.
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  bindTexture(frame, 0, Resource::Surface);
  bindTexture(frame, 1, scene);
  if (!variant.opaque) bindTexture(frame, 2, Resource::Thickness);
  glUseProgram(program->second.name());
  drawPicture();
}

}  // namespace sluice::render
