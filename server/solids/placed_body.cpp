#include "sluice/solids/placed_body.h"

namespace sluice::solids {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

PlacedBody::PlacedBody(std::shared_ptr<const BodyShape> shape, bool isGlass, const Eigen::Isometry3d& pose)
    : shape_(std::move(shape)), isSolid_(shape_->isClosed() && !isGlass) {
  moveTo(pose);
}

void PlacedBody::moveTo(const Eigen::Isometry3d& pose) {
  pose_ = pose;
  toBody_ = pose.inverse();
  const AlignedBox3d own = shape_->bounds();
  bounds_.setEmpty();
  for (int corner = 0; corner < 8; ++corner) {
    bounds_.extend(pose * own.corner(static_cast<AlignedBox3d::CornerType>(corner)));
  }
}

bool PlacedBody::contains(const Vector3d& x) const {
  return isSolid_ && bounds_.contains(x) && shape_->contains(toBody_ * x);
}

ClosestPoint PlacedBody::closest(const Vector3d& x, double reach) const {
  if (bounds_.squaredExteriorDistance(x) >= reach * reach) return {};
  ClosestPoint found = shape_->closest(toBody_ * x, reach);
  found.point = pose_ * found.point;
  return found;
}

}  // namespace sluice::solids
