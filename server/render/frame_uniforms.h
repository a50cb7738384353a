#pragma once

#include <array>

#include "light_view.h"
#include "sluice/render/frame_plan.h"
#include "sluice/v1/scene.pb.h"
#include "view_geometry.h"

namespace sluice::render {

/// What every pass knows of the frame, as std140 lays it out. Mirrors shaders/frame_uniforms.glsl, where each member is
/// described; a test compares the two.
struct FrameUniforms {
  using Vec4 = std::array<float, 4>;

  Vec4 eye;
  Vec4 rightAndSlope;
  Vec4 downAndSlope;
  Vec4 forwardAndPixel;
  Vec4 pictureSize;
  Vec4 floorAndHaze;
  Vec4 tileLight;
  Vec4 tileDark;
  Vec4 ambientRed;
  Vec4 ambientGreen;
  Vec4 ambientBlue;
  Vec4 ambientRed2;
  Vec4 ambientGreen2;
  Vec4 ambientBlue2;
  Vec4 ambientPlane;
  Vec4 floorLight;
  Vec4 backdrop;
  Vec4 sun;
  Vec4 sunlight;
  Vec4 lightCorner;
  Vec4 lightRight;
  Vec4 lightDown;
  Vec4 pictureSlopes;
};

/// Sizes of a frame's splats, m.
struct SplatScale {
  float spacing = 1;
  float radius = 1;
  float dropRadius = 1;  ///< Of spray.
  float nearDepth = 0;
};

SplatScale splatScale(const v1::Splats& splats, double spacing);

/// Unit vector towards the sun.
Eigen::Vector3f sunDirection(const v1::Sun& sun);

/// Everything but the light map's place and the ambient light, which are left 0. `target` is the view that is drawn
/// into, `picture` that of the picture.
FrameUniforms makeFrameUniforms(const ViewGeometry& target, const ViewGeometry& picture, const v1::Scene& scene);

/// Points them at another view.
void aim(FrameUniforms& uniforms, const ViewGeometry& target);

/// Fills in where a light map falls on the floor.
void placeLightMap(FrameUniforms& uniforms, const LightGrid& grid);

}  // namespace sluice::render
