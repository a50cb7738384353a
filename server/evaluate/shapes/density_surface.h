#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "shapes/surface.h"

namespace sluice::evaluate {

/// The surface of any cloud of particles, as a level set of its SPH volume fraction f(x) = Σ d³ W(x − x_j): the line of
/// sight is walked in steps of d/10 and the crossing found by bisection. The level is ½, which a
/// half-space of particles on a lattice has half a spacing outside its outermost centres, where its liquid ends.
class DensitySurface : public Surface {
 public:
  /// `positions` are finite.
  DensitySurface(const std::vector<Eigen::Vector3f>& positions, double spacing);

  std::optional<Hit> trace(const Eigen::Vector3d& eye, const Eigen::Vector3d& direction) const override;

  /// f, and its gradient, 1/m.
  double fraction(const Eigen::Vector3d& point) const;
  Eigen::Vector3d gradient(const Eigen::Vector3d& point) const;

 private:
  using Cell = std::array<std::int64_t, 3>;

  std::size_t cellIndex(const Cell& cell) const;
  Cell cellOf(const Eigen::Vector3d& point) const;
  bool isNear(const Eigen::Vector3d& point) const;
  Eigen::Vector3d outwardNormal(const Eigen::Vector3d& point) const;
  double curvature(const Eigen::Vector3d& point) const;

  /// Calls `visit` with every particle's offset to `point` that may lie within the support radius.
  template <class Visit>
  void forEachNear(const Eigen::Vector3d& point, const Visit& visit) const;

  double spacing_;
  double cellEdge_;  ///< m; at least the support radius H.
  Eigen::AlignedBox3d box_;
  Cell cells_{1, 1, 1};
  std::vector<std::uint32_t> starts_;       ///< Particles [starts_[c], starts_[c+1]) lie in cell c.
  std::vector<Eigen::Vector3f> particles_;  ///< Sorted by cell.
  std::vector<std::uint8_t> near_;          ///< Of every cell: it or a neighbour of it holds a particle.
};

}  // namespace sluice::evaluate
