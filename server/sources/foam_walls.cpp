#include "foam_walls.h"

#include <algorithm>
#include <limits>
#include <string>

#include "sluice/scene/convert.h"
#include "sluice/solids/slide.h"

namespace sluice::sources {

namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

/// That secondary particles keep from bodies, in spacings: less than their radius, so that they seem to touch.
constexpr double kClearance = 0.05;

/// A face is ground where gravity points into it at less than 45°.
constexpr double kSlopeOfGround = 0.7;

/// Share of a ball of radius h that a wall leaves open at a distance from its middle: less the cap beyond a plane at D,
/// π(h - D)²(2h + D)/3 of 4πh³/3.
float openBeside(float distance, float support, float spacing) {
  const float d = std::clamp((distance - 0.5F * spacing) / support, 0.0F, 1.0F);
  return 1 - 0.25F * (1 - d) * (1 - d) * (2 + d);
}

Eigen::Isometry3d toIsometry(const core::BodyPose& pose) {
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.translate(pose.position.cast<double>());
  result.rotate(pose.rotation.cast<double>().normalized());
  return result;
}

}  // namespace

FoamWalls::FoamWalls(const v1::Scene& scene) {
  if (!scene.has_simulation()) return;
  const v1::Simulation& simulation = scene.simulation();
  const solids::Enclosure enclosure(simulation);
  if (enclosure.isBox()) {
    box_ = enclosure.bounds().cast<float>();
  } else {
    enclosure_ = enclosure;
  }
  clearance_ = kClearance * simulation.particle_spacing();
  if (simulation.planar()) return;
  for (int k = 0; k < scene.bodies_size(); ++k) {
    const v1::Body& body = scene.bodies(k);
    if (!body.solid()) continue;
    obstacles_.push_back({{solids::makeBodyShape(body, "bodies[" + std::to_string(k) + "]"), body.has_glass(),
                           scene::toPose(body).cast<double>()},
                          static_cast<std::size_t>(k)});
  }
}

void FoamWalls::moveBodies(std::span<const core::BodyPose> poses) {
  for (Obstacle& obstacle : obstacles_) {
    if (obstacle.inScene < poses.size()) obstacle.body.moveTo(toIsometry(poses[obstacle.inScene]));
  }
}

solids::ClosestPoint FoamWalls::closestBody(const Vector3d& point, double reach) const {
  solids::ClosestPoint best;
  for (const Obstacle& obstacle : obstacles_) {
    const solids::ClosestPoint found = obstacle.body.closest(point, std::min(reach, best.distance));
    if (found.distance < best.distance) best = found;
  }
  return best;
}

float FoamWalls::openShare(const Vector3f& point, float support, float spacing) const {
  float open = 1;
  if (box_) {
    for (int axis = 0; axis < 3; ++axis) {
      open *= openBeside(point[axis] - box_->min()[axis], support, spacing) *
              openBeside(box_->max()[axis] - point[axis], support, spacing);
    }
  } else if (enclosure_) {
    enclosure_->forEachFace(point.cast<double>(), [&](const Vector3d&, double distance) {
      open *= openBeside(static_cast<float>(distance), support, spacing);
    });
  }
  for (const Obstacle& obstacle : obstacles_) {
    const double reach = static_cast<double>(support) + spacing;
    const double distance = obstacle.body.closest(point.cast<double>(), reach).distance;
    if (distance < reach) open *= openBeside(static_cast<float>(distance), support, spacing);
  }
  return open;
}

Vector3f FoamWalls::withoutWalls(Vector3f outward, const Vector3f& point, float support) const {
  if (box_) {
    for (int axis = 0; axis < 3; ++axis) {
      if (point[axis] - box_->min()[axis] < support) outward[axis] = std::max(outward[axis], 0.0F);
      if (box_->max()[axis] - point[axis] < support) outward[axis] = std::min(outward[axis], 0.0F);
    }
  }
  if (!enclosure_ && obstacles_.empty()) return outward;
  const Vector3d x = point.cast<double>();
  Vector3d left = outward.cast<double>();
  if (enclosure_) {
    enclosure_->forEachFace(x, [&](const Vector3d& normal, double distance) {
      if (distance < static_cast<double>(support)) solids::takeOutInward(left, normal);
    });
  }
  for (const Obstacle& obstacle : obstacles_) {
    const solids::ClosestPoint found = obstacle.body.closest(x, support);
    if (found.distance < static_cast<double>(support) && found.distance > 0) {
      solids::takeOutInward(left, (x - found.point) / found.distance);
    }
  }
  return left.cast<float>();
}

void FoamWalls::holdInside(Vector3f& position, Vector3f& velocity) const {
  if (box_) {
    for (int axis = 0; axis < 3; ++axis) {
      const float held = std::clamp(position[axis], box_->min()[axis], box_->max()[axis]);
      if (held != position[axis]) velocity[axis] = 0;
      position[axis] = held;
    }
  } else if (enclosure_) {
    Vector3d x = position.cast<double>();
    Vector3d v = velocity.cast<double>();
    if (!enclosure_->hold(x, v, 0)) return;
    position = x.cast<float>();
    velocity = v.cast<float>();
  }
}

void FoamWalls::hold(const Vector3f& from, Vector3f& position, Vector3f& velocity) const {
  const Vector3d start = from.cast<double>();
  const double way = (position - from).cast<double>().norm();
  const double reach = way + 2 * clearance_;
  if (obstacles_.empty() || closestBody(start, reach).distance >= reach) return holdInside(position, velocity);
  Vector3d x = start;
  Vector3d v = velocity.cast<double>();
  solids::slide(
      x, position.cast<double>(), clearance_, [&](const Vector3d& at, double far) { return closestBody(at, far); },
      [&](const Vector3d& normal, const Vector3d&) { solids::takeOutInward(v, normal); },
      [](const Vector3d&) { return false; });
  for (const Obstacle& obstacle : obstacles_) {
    // A body has come to where the particle was.
    if (!obstacle.body.contains(x)) continue;
    const solids::ClosestPoint out = obstacle.body.closest(x, std::numeric_limits<double>::infinity());
    if (out.distance > 0) x = out.point + (out.point - x) * (clearance_ / out.distance);
  }
  position = x.cast<float>();
  velocity = v.cast<float>();
  holdInside(position, velocity);
}

bool FoamWalls::isOnGround(const Vector3f& point, const Vector3f& gravity) const {
  int axis = 0;
  if (gravity.cwiseAbs().maxCoeff(&axis) == 0) return false;
  if (box_ && (gravity[axis] < 0 ? point[axis] <= box_->min()[axis] : point[axis] >= box_->max()[axis])) return true;
  const Vector3d x = point.cast<double>();
  const Vector3d up = -gravity.cast<double>().normalized();
  bool grounded = false;
  const auto stand = [&](const Vector3d& normal) { grounded = grounded || normal.dot(up) > kSlopeOfGround; };
  if (enclosure_) {
    enclosure_->forEachFace(x, [&](const Vector3d& normal, double distance) {
      // What has been held at a face is on it but for the rounding of floats.
      if (distance <= 1e-5 * (1 + x.cwiseAbs().maxCoeff())) stand(normal);
    });
  }
  const solids::ClosestPoint body = closestBody(x, 2 * clearance_);
  if (body.distance < 2 * clearance_ && body.distance > 0) stand((x - body.point) / body.distance);
  return grounded;
}

}  // namespace sluice::sources
