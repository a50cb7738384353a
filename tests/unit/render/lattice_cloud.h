#pragma once

#include <random>

#include "sluice/core/particle_snapshot.h"

namespace sluice::render {

/// A block of nx × ny × nz particles, 0.05 m apart from the origin on, each moved at random by up to `jitter` spacings
/// along every axis; with numbers of neighbours counted the slow, obvious way within two spacings and a bit.
inline core::ParticleSnapshot latticeCloud(int nx, int ny, int nz, float jitter = 0.0F) {
  core::ParticleSnapshot cloud;
  cloud.spacing = 0.05;
  std::mt19937 random(5);
  const auto moved = [&](int place) {
    const float unit = 2.0F * static_cast<float>(random() >> 8) / static_cast<float>(1U << 24) - 1.0F;
    return 0.05F * (static_cast<float>(place) + jitter * unit);
  };
  for (int z = 0; z < nz; ++z) {
    for (int y = 0; y < ny; ++y) {
      for (int x = 0; x < nx; ++x) {
        const float px = moved(x);
        const float py = moved(y);
        cloud.positions.emplace_back(px, py, moved(z));
        cloud.ids.push_back(static_cast<std::uint32_t>(cloud.ids.size()));
      }
    }
  }
  cloud.densities.assign(cloud.size(), 1000.0F);
  cloud.supportRadius = 2.01 * cloud.spacing;
  for (const Eigen::Vector3f& p : cloud.positions) {
    std::uint16_t near = 0;
    for (const Eigen::Vector3f& other : cloud.positions) {
      if ((other - p).norm() < cloud.supportRadius) ++near;
    }
    cloud.neighbours.push_back(static_cast<std::uint16_t>(near - 1));
  }
  cloud.bounds = core::boundsOf(cloud.positions);
  return cloud;
}

}  // namespace sluice::render
