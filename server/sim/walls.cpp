#include "walls.h"

#include <algorithm>

namespace sluice::sim {

namespace {

using Eigen::Vector3d;

Vector3d toVector(const Float4& v) { return Vector3d(v.x, v.y, v.z); }

Float4 toFloat4(const Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()), 0};
}

/// Takes the part out of a vector that leads against a unit normal. Returns whether there was any.
bool takeOutInward(Vector3d& vector, const Vector3d& normal) {
  const double inward = vector.dot(normal);
  if (inward >= 0) return false;
  vector -= inward * normal;
  return true;
}

}  // namespace

/// In pieces, none of which is longer than the way to the closest surface: it cannot cross one, however thin. The
/// container's faces shorten a piece and turn it, but never make it longer, for the container is convex.
bool Walls::moveAmongBodies(Float4& x, Float4& v, const Float4& to, BodySet near) const {
  // Enough for a move of 1.5 spacings in pieces of at least a quarter of one, with some to spare for corners. What is
  // left of it after them is not gone.
  constexpr int kMostPieces = 12;
  // Of the clearance: what counts as touching.
  constexpr double kTouching = 1.01;
  // Of the way to the closest surface: how far a piece may go where it does not stop at the clearance.
  constexpr double kSafeShare = 0.5;

  const double clearance = clearance_;
  Vector3d rest = toVector(to) - toVector(x);
  bool held = false;
  for (int piece = 0; piece < kMostPieces && rest.squaredNorm() > 0; ++piece) {
    const Vector3d here = toVector(x);
    const ClosestPoint closest = bodies_->closest(here, near, rest.norm() + kTouching * clearance);
    if (closest.distance < kTouching * clearance) {
      if (closest.distance == 0) return true;
      const Vector3d normal = (here - closest.point) / closest.distance;
      held = takeOutInward(rest, normal) || held;
      Vector3d velocity = toVector(v);
      if (takeOutInward(velocity, normal)) v = toFloat4(velocity);
    }
    const double length = rest.norm();
    const double allowed = std::max(closest.distance - clearance, kSafeShare * closest.distance);
    if (length <= allowed) {
      x = toFloat4(here + rest);
      rest.setZero();
    } else {
      x = toFloat4(here + rest * (allowed / length));
      rest *= 1 - allowed / length;
    }
    held = hold(x, v) || held;
  }
  const Vector3d here = toVector(x);
  const ClosestPoint closest = bodies_->closest(here, near, clearance);
  if (closest.distance < clearance && closest.distance > 0) {
    const Vector3d normal = (here - closest.point) / closest.distance;
    Vector3d velocity = toVector(v);
    if (takeOutInward(velocity, normal)) v = toFloat4(velocity);
    x = toFloat4(here + std::min(clearance - closest.distance, kSafeShare * closest.distance) * normal);
    hold(x, v);
    held = true;
  }
  return held;
}

}  // namespace sluice::sim
