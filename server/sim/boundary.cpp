#include "boundary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "enclosure_samples.h"
#include "lattice.h"

namespace sluice::sim {

namespace {

/// Intervals along each edge: the fewest that are no longer than the particle spacing; none across a plane.
std::array<std::int64_t, 3> intervals(const Container& container, double spacing) {
  std::array<std::int64_t, 3> n{};
  // A length of 62.00000001 spacings is 62 intervals, not 63.
  for (std::size_t axis = 0; axis < container.walledAxes(); ++axis) {
    n[axis] = std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(container.size[axis] / spacing - 1e-6)));
  }
  return n;
}

/// Σ_k W over a plane square lattice of spacing d, at `height` above a place that is so many spacings off a point of
/// it, 1/m³.
double planeSum(const Discretisation& discretisation, double offsetX, double offsetY, double height) {
  const double spacing = discretisation.spacing;
  const double support = discretisation.support;
  const int reach = static_cast<int>(std::ceil(support / spacing)) + 1;
  const int reachInY = discretisation.dimensions == 2 ? 0 : reach;
  return withKernel(discretisation.kernel, [&]<class Kernel>(Kernel) {
    double sum = 0;
    for (int y = -reachInY; y <= reachInY; ++y) {
      for (int x = -reach; x <= reach; ++x) {
        const double dx = (x + offsetX) * spacing;
        const double dy = (y + offsetY) * spacing;
        sum += kernelValue<Kernel>(std::sqrt(dx * dx + dy * dy + height * height), support, discretisation.dimensions);
      }
    }
    return sum;
  });
}

/// Σ_k W_bk of a particle of one of a wall's layers over all of them, 1/m³.
double densityInWall(const Discretisation& discretisation, int layers, int layer) {
  double sum = 0;
  for (int other = 0; other < layers; ++other) {
    sum += planeSum(discretisation, 0, 0, static_cast<double>(layer - other) * discretisation.spacing);
  }
  return sum;
}

}  // namespace

double wallCalibration(const Discretisation& discretisation, int layers) {
  constexpr int kOffsets = 8;
  const double spacing = discretisation.spacing;
  const int offsetsInY = discretisation.dimensions == 2 ? 1 : kOffsets;
  const double first = densityInWall(discretisation, layers, 0);
  double above = 0;
  for (int layer = 0; layer < layers; ++layer) {
    const double height = static_cast<double>(layer + 1) * spacing;
    double mean = 0;
    for (int a = 0; a < kOffsets; ++a) {
      for (int b = 0; b < offsetsInY; ++b) {
        mean += planeSum(discretisation, a / double{kOffsets}, b / double{kOffsets}, height) / (kOffsets * offsetsInY);
      }
    }
    above += mean * (first / densityInWall(discretisation, layers, layer));
  }
  const double alone =
      halfSpaceDensity(discretisation.kernel, spacing, discretisation.support, discretisation.dimensions);
  return (1 - alone) * first / above;
}

std::vector<double> wallVolumes(const Discretisation& discretisation, int layers) {
  const double calibration = wallCalibration(discretisation, layers);
  std::vector<double> volumes;
  for (int layer = 0; layer < layers; ++layer) {
    volumes.push_back(calibration / densityInWall(discretisation, layers, layer) / discretisation.volume);
  }
  return volumes;
}

std::vector<Float4> sampleBox(const Container& container, double spacing, int layers) {
  if (container.periodic) return {};
  const std::array<std::int64_t, 3> n = intervals(container, spacing);
  const std::int64_t shells = std::int64_t{layers} - 1;
  const auto place = [&](std::size_t axis, std::int64_t step) {
    return static_cast<float>(container.size[axis] * static_cast<double>(step) / static_cast<double>(n[axis]));
  };
  const auto inside = [&](std::size_t axis, std::int64_t step) { return step > 0 && step < n[axis]; };
  const std::int64_t lowZ = container.plane ? 0 : -shells;
  const std::int64_t highZ = container.plane ? 0 : n[2] + shells;
  std::vector<Float4> points;
  for (std::int64_t k = lowZ; k <= highZ; ++k) {
    const float z = container.plane ? static_cast<float>(*container.plane) : place(2, k);
    for (std::int64_t j = -shells; j <= n[1] + shells; ++j) {
      const bool throughFluid = (container.plane || inside(2, k)) && inside(1, j);
      for (std::int64_t i = -shells; i <= n[0] + shells; ++i) {
        if (throughFluid && i == 1) i = n[0];
        points.push_back({place(0, i), place(1, j), z, 0});
      }
    }
  }
  return points;
}

int boundaryLayers(const Discretisation& discretisation) {
  return std::max(1, static_cast<int>(std::ceil(discretisation.support / discretisation.spacing - 1e-6)) - 1);
}

double Boundary::expectedCount(const Container& container, const Discretisation& discretisation) {
  const int layers = boundaryLayers(discretisation);
  if (container.enclosure) return expectedEnclosureSamples(*container.enclosure, discretisation.spacing, layers);
  const int shells = layers - 1;
  double outer = 1;
  double inner = 1;
  const std::array<std::int64_t, 3> n = intervals(container, discretisation.spacing);
  for (std::size_t axis = 0; axis < container.walledAxes(); ++axis) {
    outer *= static_cast<double>(n[axis] + 1 + 2 * shells);
    inner *= static_cast<double>(n[axis] - 1);
  }
  return outer - inner;
}

Boundary::Boundary(const Container& container, const Bodies& bodies, const Discretisation& discretisation,
                   const CellGeometry& geometry, const Team& team)
    : grid_(geometry) {
  const int layers = boundaryLayers(discretisation);
  std::vector<Float4> points = container.enclosure
                                   ? sampleEnclosure(container, discretisation.spacing, discretisation.support, layers)
                                   : sampleBox(container, discretisation.spacing, layers);
  const double calibration = wallCalibration(discretisation, layers);
  const double thinCalibration = layers == 1 ? calibration : wallCalibration(discretisation, 1);
  std::vector<double> calibrations(points.size(), calibration);
  std::vector<std::uint8_t> surfaces(points.size(), kContainerSurface);
  for (const Bodies::Sample& sample : bodies.samples()) {
    points.push_back(sample.position);
    calibrations.push_back(sample.layers == 1 ? thinCalibration : calibration);
    surfaces.push_back(static_cast<std::uint8_t>(sample.body + 1));
  }
  grid_.sort(points, team);
  points_.resize(points.size());
  surfaces_.resize(points.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    points_[k] = points[grid_.order()[k]];
    surfaces_[k] = surfaces[grid_.order()[k]];
  }

  volumes_.resize(points_.size());
  withKernel(discretisation.kernel, [&]<class Kernel>(Kernel) {
    team.forEachChunk(points_.size(), [&](const Chunk& chunk) {
      for (std::size_t b = chunk.first; b < chunk.last; ++b) {
        double sum = 0;
        const CellGrid::Neighbourhood around = grid_.around(grid_.cellOfSorted()[b]);
        for (int r = 0; r < around.count; ++r) {
          for (std::uint32_t k = around.ranges[r].first; k < around.ranges[r].last; ++k) {
            const double dx = points_[b].x - points_[k].x;
            const double dy = points_[b].y - points_[k].y;
            const double dz = points_[b].z - points_[k].z;
            sum += kernelValue<Kernel>(std::sqrt(dx * dx + dy * dy + dz * dz), discretisation.support,
                                       discretisation.dimensions);
          }
        }
        volumes_[b] = static_cast<float>(calibrations[grid_.order()[b]] / sum / discretisation.volume);
      }
    });
  });
}

}  // namespace sluice::sim
