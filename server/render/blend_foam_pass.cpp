#include "foam_dots.h"
#include "passes.h"

namespace sluice::render {

BlendFoamPass::BlendFoamPass() : program_(shaders().program("picture.vert", "blend_foam.frag")) {}

void BlendFoamPass::run(const FrameContext& frame) const {
  beginTarget(frame, Resource::Picture);
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  // Colours come multiplied by their coverage.
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  bindTexture(frame, 0, Resource::Foam);
  const Eigen::Vector3f radiance = foamRadiance(frame.scene);
  glProgramUniform3f(program_.name(), 0, radiance.x(), radiance.y(), radiance.z());
  glUseProgram(program_.name());
  drawPicture();
}

}  // namespace sluice::render
