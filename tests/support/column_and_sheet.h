#pragma once

#include <cmath>
#include <cstdint>

#include "sluice/core/camera.h"
#include "sluice/core/particle_snapshot.h"
#include "sluice/sources/column_and_sheet.h"

namespace sluice::testing {

/// A snapshot of the bench cloud.
inline core::ParticleSnapshot columnAndSheet(std::size_t count, std::uint64_t seed = 1) {
  core::ParticleSnapshot snapshot;
  snapshot.spacing = std::cbrt(0.55 / static_cast<double>(count));
  snapshot.positions = sources::columnAndSheet(count, seed);
  snapshot.bounds = core::boundsOf(snapshot.positions);
  return snapshot;
}

inline core::Camera columnAndSheetCamera() { return {{1.9F, 1.25F, 3.0F}, {0.85F, 0.25F, 0.5F}, {0, 1, 0}, 45.0F}; }

}  // namespace sluice::testing
