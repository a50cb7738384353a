#include "walls.h"

#include "sluice/solids/slide.h"

namespace sluice::sim {

namespace {

using Eigen::Vector3d;

Vector3d toVector(const Float4& v) { return Vector3d(v.x, v.y, v.z); }

Float4 toFloat4(const Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()), 0};
}

}  // namespace

bool Walls::holdInside(Float4& x, Float4& v) const {
  Vector3d place = toVector(x);
  const double clearance = clearance_;
  if (enclosure_->distance(place) >= clearance) return false;
  Vector3d velocity = toVector(v);
  enclosure_->hold(place, velocity, clearance);
  x = toFloat4(place);
  v = toFloat4(velocity);
  return true;
}

bool Walls::moveAmongMovingBodies(Float4& x, Float4& v, const Float4& to, BodyPush& push) const {
  Vector3d target = toVector(to);
  Vector3d velocity = toVector(v);
  if (!moving_->deflect(toVector(x), velocity, target, static_cast<double>(clearance_), push)) {
    return moveAmongWalls(x, v, to);
  }
  v = toFloat4(velocity);
  moveAmongWalls(x, v, toFloat4(target));
  return true;
}

bool Walls::moveAmongBodies(Float4& x, Float4& v, const Float4& to, BodySet near) const {
  Vector3d place = toVector(x);
  Vector3d velocity = toVector(v);
  const bool held = solids::slide(
      place, toVector(to), static_cast<double>(clearance_),
      [&](const Vector3d& from, double reach) { return bodies_->closest(from, near, reach); },
      [&](const Vector3d& normal, const Vector3d&) { solids::takeOutInward(velocity, normal); },
      [&](Vector3d& at) {
        Float4 inside = toFloat4(at);
        Float4 along = toFloat4(velocity);
        if (!hold(inside, along)) return false;
        at = toVector(inside);
        velocity = toVector(along);
        return true;
      });
  x = toFloat4(place);
  v = toFloat4(velocity);
  return held;
}

}  // namespace sluice::sim
