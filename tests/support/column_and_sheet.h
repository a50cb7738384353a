#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "sluice/core/camera.h"
#include "sluice/core/particle_snapshot.h"

namespace sluice::testing {

/// The bench cloud: a sheet 0.5 ≤ x ≤ 2, 0 ≤ y ≤ 0.1, 0 ≤ z ≤ 1, and beside it a column 0 ≤ x ≤ 0.5, 0 ≤ z ≤ 1, filled
/// upwards from the floor until `count` particles stand there; 0.55 m³ in all, every particle moved at random by up to
/// 15 % of the spacing along each axis.
inline core::ParticleSnapshot columnAndSheet(std::size_t count, std::uint32_t seed = 1) {
  core::ParticleSnapshot snapshot;
  snapshot.spacing = std::cbrt(0.55 / static_cast<double>(count));
  const auto spacing = static_cast<float>(snapshot.spacing);
  snapshot.positions.reserve(count);

  std::mt19937 random(seed);
  // Not std::uniform_real_distribution, whose values differ between libraries.
  const auto jitter = [&] {
    return 0.15F * spacing * (2.0F * static_cast<float>(random() >> 8) / static_cast<float>(1U << 24) - 1.0F);
  };
  const auto fill = [&](Eigen::Vector3f low, Eigen::Vector3f high) {
    for (float y = low.y() + 0.5F * spacing; y < high.y(); y += spacing) {
      for (float z = low.z() + 0.5F * spacing; z < high.z(); z += spacing) {
        for (float x = low.x() + 0.5F * spacing; x < high.x(); x += spacing) {
          if (snapshot.positions.size() == count) return;
          const float dx = jitter();
          const float dy = jitter();
          const float dz = jitter();
          snapshot.positions.emplace_back(x + dx, y + dy, z + dz);
        }
      }
    }
  };
  fill({0.5F, 0.0F, 0.0F}, {2.0F, 0.1F, 1.0F});
  fill({0.0F, 0.0F, 0.0F}, {0.5F, 1e6F, 1.0F});
  snapshot.bounds = core::boundsOf(snapshot.positions);
  return snapshot;
}

inline core::Camera columnAndSheetCamera() { return {{1.9F, 1.25F, 3.0F}, {0.85F, 0.25F, 0.5F}, {0, 1, 0}, 45.0F}; }

}  // namespace sluice::testing
