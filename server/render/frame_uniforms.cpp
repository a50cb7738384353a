#include "frame_uniforms.h"

#include "pack.h"
#include "splat_model.h"

namespace sluice::render {

SplatScale splatScale(const v1::Splats& splats, double spacing) {
  SplatScale scale;
  scale.spacing = static_cast<float>(spacing);
  scale.radius = static_cast<float>(splats.radius_in_spacings() * spacing);
  scale.dropRadius = static_cast<float>(kBallOfParticle * spacing);
  // A tenth of a radius: near enough that an eye just outside the liquid sees its surface, far enough that inverse
  // depths stay within a few powers of ten.
  scale.nearDepth = 0.1F * scale.radius;
  return scale;
}

Eigen::Vector3f sunDirection(const v1::Sun& sun) {
  const v1::Vec3& direction = sun.direction();
  return Eigen::Vector3d(direction.x(), direction.y(), direction.z()).normalized().cast<float>();
}

FrameUniforms makeFrameUniforms(const ViewGeometry& view, const ViewGeometry& picture, const v1::Scene& scene) {
  const v1::Background& background = scene.background();
  const auto width = static_cast<float>(view.size.width);
  const auto height = static_cast<float>(view.size.height);
  FrameUniforms u{};
  u.eye = pack(view.eye, 0.0F);
  u.rightAndSlope = pack(view.right, view.maxSlope.x());
  u.downAndSlope = pack(view.down, view.maxSlope.y());
  u.forwardAndPixel = pack(view.forward, view.pixelSlope);
  u.pictureSize = {width, height, 1.0F / width, 1.0F / height};
  u.floorAndHaze = {static_cast<float>(background.floor_height()), static_cast<float>(background.tile_size()),
                    background.floor() ? 1.0F : 0.0F, static_cast<float>(background.haze_distance())};
  u.tileLight = pack(background.tile_light());
  u.tileDark = pack(background.tile_dark());
  u.backdrop = pack(background.backdrop().colour(), background.has_backdrop() ? 1.0 : 0.0);
  u.sun = pack(sunDirection(scene.lighting().sun()), background.has_sky() ? 1.0F : 0.0F);
  const v1::Sun& sun = scene.lighting().sun();
  const auto strength = static_cast<float>(sun.strength());
  u.sunlight = {strength * static_cast<float>(sun.colour().x()), strength * static_cast<float>(sun.colour().y()),
                strength * static_cast<float>(sun.colour().z()), 0.0F};
  u.lightCorner = {0.0F, 0.0F, 0.0F, static_cast<float>(sun.shadow())};
  u.pictureSlopes = {picture.maxSlope.x(), picture.maxSlope.y(), 0.0F, 0.0F};
  return u;
}

void placeLightMap(FrameUniforms& uniforms, const LightGrid& grid) {
  if (grid.cells() == 0) return;
  const auto onFloor = [&](float x, float y) {
    const Eigen::Vector2f place = grid.corner + grid.cell * Eigen::Vector2f(x, y);
    const float depth = grid.axes.depthOfFloor(place.y(), uniforms.floorAndHaze[0]);
    return Eigen::Vector3f(place.x() * grid.axes.right + place.y() * grid.axes.down + depth * grid.axes.along);
  };
  const Eigen::Vector3f corner = onFloor(0.0F, 0.0F);
  uniforms.lightCorner = pack(corner, uniforms.lightCorner[3]);
  uniforms.lightRight = pack(Eigen::Vector3f(onFloor(static_cast<float>(grid.width), 0.0F) - corner), 0.0F);
  uniforms.lightDown = pack(Eigen::Vector3f(onFloor(0.0F, static_cast<float>(grid.height)) - corner), 0.0F);
}

}  // namespace sluice::render
