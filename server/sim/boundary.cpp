#include "boundary.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "lattice.h"

namespace sluice::sim {

namespace {

using Size = std::array<double, 3>;

/// Intervals along each edge: the fewest that are no longer than the particle spacing.
std::array<std::int64_t, 3> intervals(const Size& size, double spacing) {
  std::array<std::int64_t, 3> n{};
  // A length of 62.00000001 spacings is 62 intervals, not 63.
  for (int axis = 0; axis < 3; ++axis) {
    n[axis] = std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(size[axis] / spacing - 1e-6)));
  }
  return n;
}

/// Points of the surface of an (nx+1)(ny+1)(nz+1) lattice that fills the box.
std::vector<Float4> samplePoints(const Size& size, double spacing) {
  const auto [nx, ny, nz] = intervals(size, spacing);
  std::vector<Float4> points;
  points.reserve(static_cast<std::size_t>(BoxBoundary::expectedCount(size, spacing)));
  for (std::int64_t k = 0; k <= nz; ++k) {
    for (std::int64_t j = 0; j <= ny; ++j) {
      const bool onFace = k == 0 || k == nz || j == 0 || j == ny;
      for (std::int64_t i = 0; i <= nx; i += onFace ? 1 : nx) {
        const auto place = [](std::int64_t step, std::int64_t steps, double length) {
          return static_cast<float>(length * static_cast<double>(step) / static_cast<double>(steps));
        };
        points.push_back({place(i, nx, size[0]), place(j, ny, size[1]), place(k, nz, size[2]), 0});
      }
    }
  }
  return points;
}

/// γ: what the lowest layer of a lattice over a plane lacks, over what a plane of particles with γ = 1 would give it.
/// The plane is a square lattice of the same spacing; the mean over where the fluid stands above it.
double planeCalibration(KernelKind kind, double spacing, double support) {
  return withKernel(kind, [&]<class Kernel>(Kernel) {
    const int reach = static_cast<int>(std::ceil(support / spacing)) + 1;
    const auto planeSum = [&](double offsetX, double offsetY, double height) {
      double sum = 0;
      for (int y = -reach; y <= reach; ++y) {
        for (int x = -reach; x <= reach; ++x) {
          const double dx = (x + offsetX) * spacing;
          const double dy = (y + offsetY) * spacing;
          sum += kernelValue<Kernel>(std::sqrt(dx * dx + dy * dy + height * height), support);
        }
      }
      return sum;
    };
    constexpr int kOffsets = 8;
    double above = 0;
    for (int a = 0; a < kOffsets; ++a) {
      for (int b = 0; b < kOffsets; ++b) {
        above += planeSum(a / double{kOffsets}, b / double{kOffsets}, spacing) / (kOffsets * kOffsets);
      }
    }
    return (1 - halfSpaceDensity(kind, spacing, support)) * planeSum(0, 0, 0) / above;
  });
}

}  // namespace

double BoxBoundary::expectedCount(const Size& size, double spacing) {
  double outer = 1;
  double inner = 1;
  for (const std::int64_t n : intervals(size, spacing)) {
    outer *= static_cast<double>(n + 1);
    inner *= static_cast<double>(n - 1);
  }
  return outer - inner;
}

BoxBoundary::BoxBoundary(const Size& size, double spacing, double support, KernelKind kernel, double fluidVolume,
                         const CellGeometry& geometry, const Team& team)
    : grid_(geometry) {
  const std::vector<Float4> points = samplePoints(size, spacing);
  grid_.sort(points, team);
  points_.resize(points.size());
  for (std::size_t k = 0; k < points.size(); ++k) points_[k] = points[grid_.order()[k]];

  const double calibration = planeCalibration(kernel, spacing, support);
  volumes_.resize(points_.size());
  withKernel(kernel, [&]<class Kernel>(Kernel) {
    team.forEachChunk(points_.size(), [&](const Chunk& chunk) {
      for (std::size_t b = chunk.first; b < chunk.last; ++b) {
        double sum = 0;
        const CellGrid::Neighbourhood around = grid_.around(grid_.cellOfSorted()[b]);
        for (int r = 0; r < around.count; ++r) {
          for (std::uint32_t k = around.ranges[r].first; k < around.ranges[r].last; ++k) {
            const double dx = points_[b].x - points_[k].x;
            const double dy = points_[b].y - points_[k].y;
            const double dz = points_[b].z - points_[k].z;
            sum += kernelValue<Kernel>(std::sqrt(dx * dx + dy * dy + dz * dz), support);
          }
        }
        volumes_[b] = static_cast<float>(calibration / sum / fluidVolume);
      }
    });
  });
}

}  // namespace sluice::sim
