#include <vector>

#include "foam_dots.h"
#include "passes.h"

namespace sluice::render {

namespace {

void drawNatively(const FrameContext& frame) {
  std::vector<FoamCover> liquids;
  for (std::size_t k = 0; k < frame.plan.surfaces.size(); ++k) {
    const BufferId surface{Resource::Surface, static_cast<std::uint8_t>(k)};
    if (frame.plan.buffer(surface) == nullptr) continue;
    const ViewGeometry view = divided(frame.view, lookOf(frame.scene, k).smoothing().divisor());
    liquids.push_back({frame.targets.read(surface), view});
  }
  FoamCovers covers{liquids, foamBed(frame.scene, frame.particles.spacing)};
  if (frame.plan.buffer(Resource::SceneDepth) != nullptr)
    covers.sceneDepth = frame.targets.read({Resource::SceneDepth});
  drawFoam(frame.foam, frame.view, covers, frame.targets.startAnew(Resource::Foam));
}

}  // namespace

FoamPass::FoamPass() : array_(gl::makeVertexArray()) {}

void FoamPass::run(const FrameContext& frame) {
  if (frame.plan.device.software) {
    drawNatively(frame);
    return;
  }
  if (!program_) program_ = shaders().program("foam.vert", "foam.frag");
  frame.targets.clear(Resource::Foam);
  beginTarget(frame, Resource::Foam);
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  glBlendFunc(GL_ONE, GL_ONE);
  aimSplats(*program_, frame.view, true);
  GLint liquids = 0;
  for (std::size_t k = 0; k < frame.plan.surfaces.size(); ++k) {
    const BufferId surface{Resource::Surface, static_cast<std::uint8_t>(k)};
    if (frame.plan.buffer(surface) == nullptr) continue;
    glBindTextureUnit(static_cast<GLuint>(liquids), frame.targets.texture(surface).name());
    const ViewGeometry view = divided(frame.view, lookOf(frame.scene, k).smoothing().divisor());
    glProgramUniform2f(program_->name(), 4 + liquids, view.maxSlope.x(), view.maxSlope.y());
    ++liquids;
  }
  glProgramUniform1i(program_->name(), 1, liquids);
  const bool hasBodies = frame.plan.buffer(Resource::SceneDepth) != nullptr;
  if (hasBodies) bindTexture(frame, 8, Resource::SceneDepth);
  glProgramUniform1i(program_->name(), 3, hasBodies ? 1 : 0);
  glProgramUniform1f(program_->name(), 2, foamBed(frame.scene, frame.particles.spacing));

  buffer_.upload(std::as_bytes(frame.foam));
  for (GLuint attribute = 0; attribute < 2; ++attribute) {
    glEnableVertexArrayAttrib(array_.name(), attribute);
    glVertexArrayAttribBinding(array_.name(), attribute, 0);
  }
  glVertexArrayAttribFormat(array_.name(), 0, 4, GL_FLOAT, GL_FALSE, 0);
  glVertexArrayAttribFormat(array_.name(), 1, 2, GL_FLOAT, GL_FALSE, offsetof(FoamDot, opacity));
  glVertexArrayVertexBuffer(array_.name(), 0, buffer_.name(), 0, sizeof(FoamDot));
  glUseProgram(program_->name());
  glBindVertexArray(array_.name());
  glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>(frame.foam.size()));
}

}  // namespace sluice::render
