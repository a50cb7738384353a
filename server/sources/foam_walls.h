#pragma once

#include <optional>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace sluice::sources {

/// The faces of the box that holds the liquid: near them neighbours are missing that a wall stands for, not air.
class FoamWalls {
 public:
  FoamWalls() = default;
  explicit FoamWalls(const Eigen::AlignedBox3f& box) : box_(box) {}

  const std::optional<Eigen::AlignedBox3f>& box() const { return box_; }

  /// The share of the ball of radius h about a point that is on the liquid's side of the walls, in (0, 1], from the
  /// volumes of the caps that they cut off. A particle's own half spacing belongs to the liquid.
  float openShare(const Eigen::Vector3f& point, float support, float spacing) const;

  /// A direction without what points out through walls that are closer than h.
  Eigen::Vector3f withoutWalls(Eigen::Vector3f outward, const Eigen::Vector3f& point, float support) const;

 private:
  std::optional<Eigen::AlignedBox3f> box_;
};

}  // namespace sluice::sources
