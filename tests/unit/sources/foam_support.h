#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include <Eigen/Core>

#include "foam_grid.h"

namespace sluice::sources::test {

/// A number in [-1, 1) for each (particle, axis).
inline float noise(std::size_t particle, int axis) {
  const auto mixed = static_cast<std::uint32_t>((particle * 3 + static_cast<std::size_t>(axis) + 1) * 2654435769U);
  return static_cast<float>(mixed ^ (mixed >> 15)) * 0x1p-31F - 1.0F;
}

using Flow = std::function<Eigen::Vector3f(const Eigen::Vector3f&)>;

/// A unit cube of liquid from the origin on, `n` particles to an edge, each moved by up to a tenth of a spacing.
struct Cube {
  Cube(int n, const Flow& flow) : spacing(1.0F / static_cast<float>(n)) {
    for (int z = 0; z < n; ++z) {
      for (int y = 0; y < n; ++y) {
        for (int x = 0; x < n; ++x) {
          const std::size_t i = positions.size();
          const Eigen::Vector3f cell(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
          const Eigen::Vector3f jitter(noise(i, 0), noise(i, 1), noise(i, 2));
          positions.emplace_back(spacing * (cell + Eigen::Vector3f::Constant(0.5F) + 0.1F * jitter));
          velocities.push_back(flow(positions.back()));
        }
      }
    }
  }

  LiquidGrid grid(int threads = 1) const {
    LiquidGrid made;
    made.build(positions, velocities, 2 * spacing, threads);
    return made;
  }

  float spacing;
  std::vector<Eigen::Vector3f> positions;
  std::vector<Eigen::Vector3f> velocities;
};

inline Eigen::Vector3f atRest(const Eigen::Vector3f&) { return Eigen::Vector3f::Zero(); }

/// Two halves that meet head-on at x = 1/2.
inline Eigen::Vector3f colliding(const Eigen::Vector3f& x) { return {x.x() < 0.5F ? 2.0F : -2.0F, 0, 0}; }

}  // namespace sluice::sources::test
