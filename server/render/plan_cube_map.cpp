#include "composite_variant.h"
#include "planner.h"

namespace sluice::render {

void Planner::planCubeMap() {
  if (const auto why = whyNoCubeMap(look().liquid(), scene_)) {
    leaveOut(Pass::CubeMap, *why);
    return;
  }
  const auto edge = static_cast<int>(look().liquid().cube_map().edge());
  allocate(Resource::CubeMap, PixelFormat::Rgba16fRg32fTimes6, {edge, edge});
  if (traits().cubeMap) {
    leaveOut(Pass::CubeMap, "bodies, light and the liquid's middle are those of the last frame");
  } else {
    std::vector<Resource> reads{Resource::Particles};
    if (plan_.buffer(Resource::BodyShadowMap) != nullptr) reads.push_back(Resource::BodyShadowMap);
    run(Pass::CubeMap, reads, {Resource::CubeMap});
  }
}

}  // namespace sluice::render
