#include "passes.h"

namespace sluice::render {

BackgroundPass::BackgroundPass() : sky_(shaders().program("background.vert", "background.frag")) {}

void BackgroundPass::run(const FrameContext& frame) {
  beginTarget(frame, Resource::Background);
  glEnable(GL_CLIP_DISTANCE0);
  glUseProgram(sky_.name());
  drawPicture();
  if (frame.scene.background().floor()) {
    const std::pair variant(frame.plan.buffer(Resource::SceneDepth) != nullptr,
                            !frame.scene.lighting().point_lights().empty());
    auto floor = floors_.find(variant);
    if (floor == floors_.end()) {
      std::vector<std::string_view> defines{"FLOOR"};
      if (variant.first) defines.emplace_back("BODIES");
      if (variant.second) defines.emplace_back("LAMPS");
      floor = floors_.emplace(variant, shaders().program("background.vert", "background.frag", defines)).first;
    }
    glUseProgram(floor->second.name());
    drawPicture();
  }
}

}  // namespace sluice::render
