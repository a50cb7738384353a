#include "passes.h"

namespace sluice::render {

std::vector<std::string_view> CompositeVariant::defines() const {
  std::vector<std::string_view> names;
  if (opaque) names.emplace_back("OPAQUE");
  if (specular) names.emplace_back("SPECULAR");
  if (normals) names.emplace_back("NORMALS");
  return names;
}

void CompositePass::run(const FrameContext& frame) {
  const CompositeVariant variant{frame.look.liquid().opaque(), frame.look.liquid().specular() > 0,
                                 view_ == View::Normals};
  auto program = programs_.find(variant);
  if (program == programs_.end()) {
    program = programs_.emplace(variant, shaders().program("picture.vert", "composite.frag", variant.defines())).first;
  }

  const Resource scene = frame.plan.buffer(Resource::Scene) != nullptr ? Resource::Scene : Resource::Background;
  const core::ImageSize size = frame.view.size;
  glCopyImageSubData(frame.targets.texture(scene).name(), GL_TEXTURE_2D, 0, 0, 0, 0,
                     frame.targets.texture(Resource::Picture).name(), GL_TEXTURE_2D, 0, 0, 0, 0, size.width,
                     size.height, 1);

  beginTarget(frame, Resource::Picture);
  keepToLiquid();
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  // The picture itself stays opaque.
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
  glBindTextureUnit(0, frame.targets.texture(Resource::Surface).name());
  glBindTextureUnit(1, frame.targets.texture(scene).name());
  if (!variant.opaque) glBindTextureUnit(2, frame.targets.texture(Resource::Thickness).name());
  glUseProgram(program->second.name());
  drawPicture();
}

}  // namespace sluice::render
