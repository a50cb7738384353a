#include "frame_uniforms.h"
#include "kept_light_map.h"
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

void Planner::planSunlight() {
  const v1::Sun& sun = scene_.lighting().sun();
  if (liquidsWithSplats() == 0 && !anySpray()) {
    leaveOut(Pass::Sunlight, "no liquid is in the picture");
  } else if (!scene_.background().floor() && !hasBodies()) {
    leaveOut(Pass::Sunlight, "there is no floor, nor a body, that it could fall on");
  } else if (sun.strength() <= 0) {
    leaveOut(Pass::Sunlight, "lighting.sun.strength is 0");
  } else if (sunDirection(sun).y() < LightMapper::kLeastRise) {
    leaveOut(Pass::Sunlight, "the sun is at the horizon or below");
  } else if (sun.shadow() <= 0) {
    leaveOut(Pass::Sunlight, "lighting.sun.shadow is 0");
  } else {
    hasScene_ = true;
    allocate(Resource::Scene, PixelFormat::Rgba16f, size_);
    std::vector<Resource> reads{Resource::Particles, Resource::Background};
    if (hasBodies()) reads.push_back(Resource::SceneDepth);
    run(Pass::Sunlight, reads, {Resource::LightMap, Resource::Scene});
    planCaustics();
  }
}

void Planner::planCaustics() {
  if (scene_.lighting().sun().caustics() <= 0) return leaveOut("caustics", "lighting.sun.caustics is 0");
  for (std::size_t k = 0; k < liquids_.size(); ++k) {
    const v1::Liquid& liquid = lookOf(scene_, k).liquid();
    if (!castsFullShadow(liquid) && liquid.refractive_index() > 1) return;
  }
  leaveOut("caustics", "no liquid lets light through and refracts it");
}

}  // namespace sluice::render
