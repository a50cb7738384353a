#pragma once

#include <array>

#include "body_scene.h"
#include "sluice/v1/scene.pb.h"

namespace sluice::render {

/// Lights on bodies and floor, as std140 lays them out. Mirrors shaders/scene_lights.glsl, where each member is
/// described; a test compares the two.
struct SceneLights {
  using Vec4 = std::array<float, 4>;

  Vec4 sunlight;
  Vec4 toShadowU;
  Vec4 toShadowV;
  Vec4 toShadowDepth;
  Vec4 counts;
  std::array<Vec4, 8> lampPlace;
  std::array<Vec4, 8> lampLight;
  std::array<Vec4, 8> contact;
  std::array<Vec4, 8> body;
};

/// Texels along either side of the bodies' shadow map.
inline constexpr int kBodyShadowEdge = 1024;

/// The shadow map covers the ball around the bodies that are no glass, seen along the sunlight.
SceneLights makeSceneLights(const v1::Scene& scene, const BodyScene& bodies);

}  // namespace sluice::render
