#include "moving_boundary.h"

#include <algorithm>
#include <cmath>

#include "kernel.h"

namespace sluice::sim {

namespace {

double distanceOf(const Float4& a, const Float4& b) {
  const double dx = a.x - b.x;
  const double dy = a.y - b.y;
  const double dz = a.z - b.z;
  return std::sqrt(dx * dx + dy * dy + dz * dz);
}

/// Calls `visit(k)` for the points that may be within reach of a cell.
template <class Visit>
void forEachAround(const CellGrid& grid, std::uint32_t cell, Visit&& visit) {
  const CellGrid::Neighbourhood around = grid.around(cell);
  for (int r = 0; r < around.count; ++r) {
    for (std::uint32_t k = around.ranges[static_cast<std::size_t>(r)].first;
         k < around.ranges[static_cast<std::size_t>(r)].last; ++k) {
      visit(k);
    }
  }
}

}  // namespace

MovingBoundary::MovingBoundary(const MovingBodies& bodies, const Discretisation& discretisation,
                               const CellGeometry& geometry, int layers)
    : discretisation_(discretisation), grid_(geometry) {
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    if (!bodies.isSolid(k)) continue;
    const solids::PlacedBody& body = bodies.body(k);
    const std::size_t first = samples_.size();
    const double calibration = wallCalibration(discretisation, body.isSolid() ? layers : 1);
    body.shape().sample(bodies.sampling(k), [&](const Eigen::Vector3d& own) {
      samples_.push_back({own, static_cast<std::uint8_t>(k), 0, calibration});
    });
    // A grid of its own about the body finds each sample's fellows, who never leave it.
    const Eigen::AlignedBox3d box = body.shape().bounds();
    std::vector<Float4> points;
    for (std::size_t s = first; s < samples_.size(); ++s) {
      const Eigen::Vector3f x = (samples_[s].own - box.min()).cast<float>();
      points.push_back({x.x(), x.y(), x.z(), 0});
    }
    const Eigen::Vector3d size = box.sizes();
    CellGrid own(CellGeometry::covering({size.x(), size.y(), size.z()}, discretisation.support,
                                        std::max<std::uint64_t>(1U << 16U, 8 * points.size())));
    own.sort(points, Team(1));
    withKernel(discretisation.kernel, [&]<class Kernel>(Kernel) {
      for (std::size_t sorted = 0; sorted < points.size(); ++sorted) {
        const std::uint32_t s = own.order()[sorted];
        double sum = 0;
        forEachAround(own, own.cellOfSorted()[sorted], [&](std::uint32_t k2) {
          sum += kernelValue<Kernel>(distanceOf(points[s], points[own.order()[k2]]), discretisation.support,
                                     discretisation.dimensions);
        });
        samples_[first + s].ownSum = sum;
      }
    });
  }
}

void MovingBoundary::update(const MovingBodies& bodies, const Boundary& standing, const Team& team) {
  if (samples_.empty()) return;
  unsorted_.resize(samples_.size());
  points_.resize(samples_.size());
  volumes_.resize(samples_.size());
  body_.resize(samples_.size());
  team.forEachChunk(samples_.size(), [&](const Chunk& chunk) {
    for (std::size_t s = chunk.first; s < chunk.last; ++s) {
      const Eigen::Vector3f x = (bodies.body(samples_[s].body).pose() * samples_[s].own).cast<float>();
      unsorted_[s] = {x.x(), x.y(), x.z(), 0};
    }
  });
  grid_.sort(unsorted_, team);
  team.forEachChunk(samples_.size(), [&](const Chunk& chunk) {
    for (std::size_t b = chunk.first; b < chunk.last; ++b) {
      points_[b] = unsorted_[grid_.order()[b]];
      body_[b] = samples_[grid_.order()[b]].body;
    }
  });
  withKernel(discretisation_.kernel, [&]<class Kernel>(Kernel) {
    team.forEachChunk(samples_.size(), [&](const Chunk& chunk) {
      for (std::size_t b = chunk.first; b < chunk.last; ++b) {
        const Sample& sample = samples_[grid_.order()[b]];
        double sum = sample.ownSum;
        const auto add = [&](const Float4& other) {
          sum +=
              kernelValue<Kernel>(distanceOf(points_[b], other), discretisation_.support, discretisation_.dimensions);
        };
        const std::uint32_t cell = grid_.cellOfSorted()[b];
        forEachAround(grid_, cell, [&](std::uint32_t k) {
          if (body_[k] != sample.body) add(points_[k]);
        });
        forEachAround(standing.grid(), cell, [&](std::uint32_t k) { add(standing.points()[k]); });
        volumes_[b] = static_cast<float>(sample.calibration / sum / discretisation_.volume);
      }
    });
  });
}

std::uint64_t MovingBoundary::bytes() const {
  return samples_.size() * (sizeof(Sample) + 2 * sizeof(Float4) + sizeof(float) + 1 + 3 * sizeof(std::uint32_t)) +
         grid_.starts().size() * sizeof(std::uint32_t);
}

}  // namespace sluice::sim
