#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace sluice::sources {

/// The liquid around one cell, side by side in memory and padded to full blocks with particles that are far from
/// everything and at rest.
struct NearbyLiquid {
  std::vector<float> x, y, z;           ///< m.
  std::vector<float> vx, vy, vz;        ///< m/s.
  std::vector<std::uint32_t> particle;  ///< Places in the grid's order, without padding.

  std::size_t padded() const { return x.size(); }
};

/// A snapshot's particles sorted into cubic cells at least a support radius wide. Read by any number of threads.
class LiquidGrid {
 public:
  /// Velocities that are not finite, as a damaged file may hold, count as none.
  void build(std::span<const Eigen::Vector3f> positions, std::span<const Eigen::Vector3f> velocities, float support,
             int threads);

  std::size_t size() const { return order_.size(); }
  /// Of the particles; a point where there are none.
  const Eigen::AlignedBox3f& bounds() const { return bounds_; }

  /// The place in the snapshot of the particle that is k-th in the grid's order: by cell, then as they came.
  std::uint32_t inSnapshot(std::size_t k) const { return order_[k]; }
  Eigen::Vector3f position(std::size_t k) const { return {x_[k], y_[k], z_[k]}; }
  Eigen::Vector3f velocity(std::size_t k) const { return {vx_[k], vy_[k], vz_[k]}; }

  std::uint32_t cellCount() const { return static_cast<std::uint32_t>(starts_.size()) - 1; }
  /// Points beyond the particles' bounds belong to the nearest cell.
  std::uint32_t cellOf(const Eigen::Vector3f& point) const;

  struct Range {
    std::uint32_t first = 0;
    std::uint32_t last = 0;
  };
  /// The particles of one cell.
  Range particlesOf(std::uint32_t cell) const { return {starts_[cell], starts_[cell + 1]}; }

  /// Everything that can lie within the support radius of a point in `cell`: up to nine ranges of particles.
  struct Ranges {
    std::array<Range, 9> ranges;
    std::size_t count = 0;

    std::span<const Range> all() const { return std::span(ranges).first(count); }
  };
  Ranges around(std::uint32_t cell) const;

  void gather(std::uint32_t cell, NearbyLiquid& nearby) const;

 private:
  Eigen::AlignedBox3f bounds_;
  float inverseEdge_ = 1;
  std::array<std::uint32_t, 3> cells_{1, 1, 1};
  std::vector<std::uint32_t> starts_{0, 0};
  std::vector<std::uint32_t> cellOf_;
  std::vector<std::uint32_t> order_;
  std::vector<float> x_, y_, z_, vx_, vy_, vz_;
};

}  // namespace sluice::sources
