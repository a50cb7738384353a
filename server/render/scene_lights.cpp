#include "scene_lights.h"

#include <algorithm>

#include "frame_uniforms.h"
#include "pack.h"

namespace sluice::render {

namespace {

SceneLights::Vec4 scaled(const v1::Vec3& colour, double strength) {
  return {static_cast<float>(colour.x() * strength), static_cast<float>(colour.y() * strength),
          static_cast<float>(colour.z() * strength), 0.0F};
}

/// The affine map x ↦ axis·(x − origin)·scale + ½ as a row.
SceneLights::Vec4 row(const Eigen::Vector3f& axis, const Eigen::Vector3f& origin, float scale) {
  return pack(scale * axis, 0.5F - scale * axis.dot(origin));
}

/// The smallest ball around two.
BodyScene::Ball around(const BodyScene::Ball& a, const BodyScene::Ball& b) {
  const Eigen::Vector3f way = b.centre - a.centre;
  const float distance = way.norm();
  if (distance + b.radius <= a.radius) return a;
  if (distance + a.radius <= b.radius) return b;
  const float radius = 0.5F * (distance + a.radius + b.radius);
  return {a.centre + way * ((radius - a.radius) / distance), radius};
}

}  // namespace

SceneLights makeSceneLights(const v1::Scene& scene, const BodyScene& bodies) {
  SceneLights lights{};
  const v1::Sun& sun = scene.lighting().sun();
  lights.sunlight = scaled(sun.colour(), sun.strength());
  lights.sunlight[3] = static_cast<float>(sun.shadow());

  const BodyScene::Ball ball = bodies.matteBounds();
  const bool shadows = ball.radius > 0.0F && sun.strength() > 0 && sun.shadow() > 0;
  if (shadows) {
    // Room for the filter at the border.
    const float reach = 1.02F * ball.radius;
    const Eigen::Vector3f towards = sunDirection(sun);
    const Eigen::Vector3f u = towards.unitOrthogonal();
    lights.toShadowU = row(u, ball.centre, 0.5F / reach);
    lights.toShadowV = row(towards.cross(u), ball.centre, 0.5F / reach);
    lights.toShadowDepth = row(-towards, ball.centre, 0.5F / reach);
    lights.counts[2] = 2.0F * reach / kBodyShadowEdge;
    lights.counts[3] = 1.0F;
  }

  const auto lamps =
      std::min<std::size_t>(lights.lampPlace.size(), static_cast<std::size_t>(scene.lighting().point_lights_size()));
  lights.counts[0] = static_cast<float>(lamps);
  for (std::size_t i = 0; i < lamps; ++i) {
    const v1::PointLight& lamp = scene.lighting().point_lights(static_cast<int>(i));
    lights.lampPlace[i] = pack(lamp.position());
    lights.lampLight[i] = scaled(lamp.colour(), lamp.strength());
  }

  std::vector<BodyScene::Ball> balls;
  for (const BodyInstance& body : bodies.bodies()) {
    if (!body.isGlass()) balls.push_back(boundsOf(body));
  }
  std::ranges::sort(balls, std::ranges::greater{}, &BodyScene::Ball::radius);
  const std::size_t contacts = std::min(balls.size(), lights.contact.size());
  lights.counts[1] = static_cast<float>(contacts);
  for (std::size_t i = 0; i < contacts; ++i) {
    lights.contact[i] = pack(balls[i].centre, kContactRadius * balls[i].radius);
  }
  // The smallest of many share the last.
  for (std::size_t i = lights.body.size(); i < balls.size(); ++i) {
    balls[lights.body.size() - 1] = around(balls[lights.body.size() - 1], balls[i]);
  }
  for (std::size_t i = 0; i < contacts; ++i) lights.body[i] = pack(balls[i].centre, balls[i].radius);
  return lights;
}

}  // namespace sluice::render
