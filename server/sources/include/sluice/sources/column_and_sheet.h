#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "sluice/core/particle_source.h"
#include "sluice/v1/scene.pb.h"

namespace sluice::sources {

/// The bench cloud, m: n particles on a lattice of spacing cbrt(0.55/n), layer by layer; first a sheet 0.5 ≤ x ≤ 2,
/// 0 ≤ y ≤ 0.1, 0 ≤ z ≤ 1, then a column 0 ≤ x ≤ 0.5, 0 ≤ z ≤ 1, filled upwards from the floor until there are n. Each
/// is moved at random by up to 0.15 spacings along every axis. The same n and seed give the same bits everywhere.
std::vector<Eigen::Vector3f> columnAndSheet(std::size_t n, std::uint64_t seed);

/// A source at rest that holds the bench cloud of a complete, valid scene (which must have `column_and_sheet` set).
std::unique_ptr<core::ParticleSource> openColumnAndSheet(const v1::Scene& scene);

}  // namespace sluice::sources
