#pragma once

#include <memory>

#include "sluice/solids/body_shape.h"

namespace sluice::solids {

/// A body's surface where it is in the scene. A matte body with a closed surface is solid; one of glass, or with an
/// open surface, is a thin wall with room for fluid on both sides.
class PlacedBody {
 public:
  PlacedBody(std::shared_ptr<const BodyShape> shape, bool isGlass, const Eigen::Isometry3d& pose);

  const BodyShape& shape() const { return *shape_; }
  bool isSolid() const { return isSolid_; }

  /// From the body's own axes to the scene's.
  const Eigen::Isometry3d& pose() const { return pose_; }
  const Eigen::AlignedBox3d& bounds() const { return bounds_; }
  void moveTo(const Eigen::Isometry3d& pose);

  /// Whether a point lies within a solid body.
  bool contains(const Eigen::Vector3d& x) const;

  /// Whether a point lies within a solid body, or nearer to the surface than `distance`.
  bool isNearer(const Eigen::Vector3d& x, double distance) const {
    return contains(x) || closest(x, distance).distance < distance;
  }

  /// The surface's closest point; one that is not nearer than `reach` need not be found.
  ClosestPoint closest(const Eigen::Vector3d& x, double reach) const;

 private:
  std::shared_ptr<const BodyShape> shape_;
  bool isSolid_;
  Eigen::Isometry3d pose_;
  Eigen::Isometry3d toBody_;
  Eigen::AlignedBox3d bounds_;
};

}  // namespace sluice::solids
