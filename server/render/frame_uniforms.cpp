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

void aim(FrameUniforms& u, const ViewGeometry& target) {
  const auto width = static_cast<float>(target.size.width);
  const auto height = static_cast<float>(target.size.height);
  u.eye = pack(target.eye, 0.0F);
  u.rightAndSlope = pack(target.right, target.maxSlope.x());
  u.downAndSlope = pack(target.down, target.maxSlope.y());
  u.forwardAndPixel = pack(target.forward, target.pixelSlope);
  u.pictureSize = {width, height, 1.0F / width, 1.0F / height};
}

FrameUniforms makeFrameUniforms(const ViewGeometry& view, const ViewGeometry& picture, const v1::Scene& scene) {
  const v1::Background& background = scene.background();
  FrameUniforms u{};
  aim(u, view);
  u.floorAndHaze = {static_cast<float>(background.floor_height()), static_cast<float>(background.tile_size()),
                    background.floor() ? 1.0F : 0.0F, static_cast<float>(background.haze_distance())};
  u.tileLight = pack(background.tile_light());
  u.tileDark = pack(background.tile_dark());
  u.backdrop = pack(background.backdrop().colour(), background.has_backdrop() ? 1.0 : 0.0);
  // As the picture of the background holds it, so that it makes no difference whether that is looked up.
  for (float& component : u.backdrop) component = static_cast<float>(Eigen::half(component));
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
