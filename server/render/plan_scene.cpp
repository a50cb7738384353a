#include "planner.h"

namespace sluice::render {

void Planner::planBackground() {
  allocate(Resource::Background, PixelFormat::Rgba16f, size_);
  if (scene_.lighting().point_lights().empty()) leaveOut("lamps", "lighting.point_lights is empty");
  if (reuse_.background) {
    leaveOut(Pass::Background, "camera, size and background are those of the last frame");
  } else {
    run(Pass::Background, hasBodies() ? std::vector{Resource::BodyShadowMap} : std::vector<Resource>{},
        {Resource::Background});
  }
}

void Planner::planGroundShadow() {
  if (liquidsWithSplats() == 0 && !anySpray()) return;
  if (!scene_.background().floor()) {
    leaveOut(Pass::GroundShadow, "there is no floor");
  } else if (scene_.lighting().sun().shadow() <= 0) {
    leaveOut(Pass::GroundShadow, "lighting.sun.shadow is 0");
  } else {
    hasScene_ = true;
    allocate(Resource::Scene, PixelFormat::Rgba16f, size_);
    run(Pass::GroundShadow, {Resource::Particles, Resource::Background}, {Resource::ShadowMap, Resource::Scene});
  }
}

}  // namespace sluice::render
