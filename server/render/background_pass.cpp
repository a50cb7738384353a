#include "passes.h"

namespace sluice::render {

BackgroundPass::BackgroundPass() : sky_(shaders().program("background.vert", "background.frag")) {}

void BackgroundPass::run(const FrameContext& frame) {
  beginTarget(frame, Resource::Background);
  glEnable(GL_CLIP_DISTANCE0);
  glUseProgram(sky_.name());
  drawPicture();
  if (!frame.scene.background().floor()) return;
  const bool hasLamps = !frame.scene.lighting().point_lights().empty();
  const bool hasBodies = frame.plan.buffer(Resource::SceneDepth) != nullptr;
  useFloor(false, hasLamps);
  if (!hasBodies || frame.shadedFloor.empty()) {
    drawPicture();
    return;
  }
  drawPicture(complement(frame.shadedFloor, frame.view.size));
  useFloor(true, hasLamps);
  drawPicture(frame.shadedFloor);
}

void BackgroundPass::useFloor(bool bodies, bool lamps) {
  const std::pair variant(bodies, lamps);
  auto floor = floors_.find(variant);
  if (floor == floors_.end()) {
    std::vector<std::string_view> defines{"FLOOR"};
    if (bodies) defines.emplace_back("BODIES");
    if (lamps) defines.emplace_back("LAMPS");
    floor = floors_.emplace(variant, shaders().program("background.vert", "background.frag", defines)).first;
  }
  glUseProgram(floor->second.name());
}

}  // namespace sluice::render
