#include "sluice/solids/enclosure.h"

#include <algorithm>
#include <limits>
#include <string>

#include "sluice/core/input_error.h"
#include "sluice/scene/convert.h"
#include "sluice/solids/slide.h"

namespace sluice::solids {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

Enclosure::Enclosure(const v1::Simulation& simulation) {
  const auto addSlab = [&](int axis) {
    const Vector3d unit = Vector3d::Unit(axis);
    planes_.push_back({unit, bounds_.min()[axis]});
    planes_.push_back({-unit, -bounds_.max()[axis]});
  };
  if (simulation.has_spherical_container()) {
    const v1::RoundContainer& sphere = simulation.spherical_container();
    round_ = {scene::toVector(sphere.centre()), sphere.radius(), false};
    const Vector3d reach = Vector3d::Constant(sphere.radius());
    bounds_ = AlignedBox3d(round_->centre - reach, round_->centre + reach);
  } else if (simulation.has_cylindrical_container()) {
    const v1::UprightContainer& cylinder = simulation.cylindrical_container();
    const Vector3d base = scene::toVector(cylinder.base());
    round_ = {base, cylinder.radius(), true};
    const Vector3d reach(cylinder.radius(), 0, cylinder.radius());
    bounds_ = AlignedBox3d(Vector3d(base - reach), Vector3d(base + reach + cylinder.height() * Vector3d::UnitY()));
    addSlab(1);
  } else {
    bounds_ =
        AlignedBox3d(scene::toVector(simulation.container().min()), scene::toVector(simulation.container().max()));
    for (int axis = 0; axis < 3; ++axis) addSlab(axis);
  }
  ownPlanes_ = planes_.size();
  for (int k = 0; k < simulation.planes_size(); ++k) {
    const Vector3d normal = scene::toVector(simulation.planes(k).normal()).normalized();
    const Plane plane{normal, normal.dot(scene::toVector(simulation.planes(k).point()))};
    double farthest = -std::numeric_limits<double>::infinity();
    for (int corner = 0; corner < 8; ++corner) {
      const Vector3d x = bounds_.corner(static_cast<AlignedBox3d::CornerType>(corner));
      farthest = std::max(farthest, normal.dot(x) - plane.offset);
    }
    if (farthest <= 0) {
      throw core::InputError("", "simulation.planes[" + std::to_string(k) + "]",
                             "the whole container lies behind the plane; its normal has to point towards the fluid");
    }
    planes_.push_back(plane);
  }
}

Enclosure Enclosure::relativeTo(const Vector3d& origin) const {
  Enclosure moved = *this;
  for (Plane& plane : moved.planes_) plane.offset -= plane.normal.dot(origin);
  if (moved.round_) moved.round_->centre -= origin;
  moved.bounds_.translate(-origin);
  return moved;
}

double Enclosure::distance(const Vector3d& x) const {
  double nearest = std::numeric_limits<double>::infinity();
  forEachFace(x, [&](const Vector3d&, double distance) { nearest = std::min(nearest, distance); });
  return nearest;
}

bool Enclosure::hold(Vector3d& x, Vector3d& velocity, double clearance) const {
  // Where faces meet, holding at one may lead behind another; projections in turn come as near to all of them as
  // anybody wants (von Neumann 1949), in one round where the faces are at right angles.
  constexpr int kMostRounds = 16;
  bool held = false;
  for (int round = 0; round < kMostRounds; ++round) {
    bool moved = false;
    // Each face sees where those before it have put the point.
    forEachFace(x, [&](const Vector3d& normal, double distance) {
      if (distance >= clearance) return;
      x += (clearance - distance) * normal;
      takeOutInward(velocity, normal);
      moved = true;
    });
    held = held || moved;
    if (!moved) break;
  }
  return held;
}

}  // namespace sluice::solids
