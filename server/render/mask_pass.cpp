#include "passes.h"

namespace sluice::render {

MaskPass::MaskPass() : program_(shaders().program("picture.vert", "mask.frag")) {}

void MaskPass::run(const FrameContext& frame) {
  frame.targets.clearStencil();
  bindTexture(frame, 0, Resource::Surface);
  beginStencil(frame);
  glStencilFunc(GL_ALWAYS, stencilOf(0), 0xFF);
  glUseProgram(program_.name());
  drawPicture({&frame.place, 1});
  if (frame.targets.has(Resource::SceneDepth) && !frame.bodyPlaces.empty()) takeOutHidden(frame);
  endStencil();
}

void MaskPass::runLayers(const FrameContext& frame) {
  if (!layers_) layers_ = shaders().program("picture.vert", "mask.frag", std::array{std::string_view("LAYERED")});
  bindTexture(frame, 0, Resource::Surface);
  bindOtherSurfaces(frame, *layers_);
  beginStencil(frame);
  glUseProgram(layers_->name());
  // Layer 0 is what the mask has written.
  for (int layer = 1; layer < frame.plan.layers; ++layer) {
    glProgramUniform1i(layers_->name(), 21, layer);
    glStencilFunc(GL_EQUAL, stencilOf(layer), kLiquidBit);
    drawPicture({&frame.place, 1});
  }
  endStencil();
}

void MaskPass::takeOutHidden(const FrameContext& frame) {
  if (!hidden_) hidden_ = shaders().program("picture.vert", "mask.frag", std::array{std::string_view("BODIES")});
  // The surface may be coarser than the picture.
  const int divisor = static_cast<int>(frame.look.smoothing().divisor());
  std::vector<PixelRect> places;
  for (const PixelRect& rect : frame.bodyPlaces) {
    places.push_back({rect.left / divisor, rect.top / divisor, rect.width / divisor + 2, rect.height / divisor + 2});
  }
  bindTexture(frame, 7, Resource::SceneDepth);
  glStencilFunc(GL_ALWAYS, 0, 0xFF);
  glUseProgram(hidden_->name());
  drawPicture(places);
}

}  // namespace sluice::render
