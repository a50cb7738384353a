#include "lattice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace sluice::sim {

namespace {

/// Σ d^D W over the lattice points with index z ≥ lowest; in two dimensions the lattice lies in the plane of x and z.
double latticeSum(KernelKind kind, double spacing, double support, int dimensions, int lowest) {
  return withKernel(kind, [&]<class Kernel>(Kernel) {
    const int reach = static_cast<int>(std::ceil(support / spacing));
    const int reachInY = dimensions == 2 ? 0 : reach;
    double sum = 0;
    for (int z = lowest < -reach ? -reach : lowest; z <= reach; ++z) {
      for (int y = -reachInY; y <= reachInY; ++y) {
        for (int x = -reach; x <= reach; ++x) {
          const double distance = spacing * std::sqrt(static_cast<double>(x * x + y * y + z * z));
          sum += kernelValue<Kernel>(distance, support, dimensions);
        }
      }
    }
    return sum * supportPower(spacing, dimensions);
  });
}

constexpr int kEverywhere = -1000;

}  // namespace

double latticeDensity(KernelKind kernel, double spacing, double support, int dimensions) {
  return latticeSum(kernel, spacing, support, dimensions, kEverywhere);
}

double particleVolume(KernelKind kernel, double spacing, double support, int dimensions) {
  return supportPower(spacing, dimensions) / latticeDensity(kernel, spacing, support, dimensions);
}

double halfSpaceDensity(KernelKind kernel, double spacing, double support, int dimensions) {
  return latticeSum(kernel, spacing, support, dimensions, 0) / latticeDensity(kernel, spacing, support, dimensions);
}

double viscosityDeficit(KernelKind kernel, double spacing, double support, int dimensions) {
  constexpr int kOffsets = 16;
  return withKernel(kernel, [&]<class Kernel>(Kernel) {
    const int reach = static_cast<int>(std::ceil(support / spacing)) + 1;
    const int reachInZ = dimensions == 2 ? 0 : reach;
    double sum = 0;
    for (int offset = 0; offset < kOffsets; ++offset) {
      const double slid = (offset + 0.5) / kOffsets;
      for (int z = -reachInZ; z <= reachInZ; ++z) {
        for (int y = -reach; y <= reach; ++y) {
          for (int x = -2 * reach; x <= 2 * reach; ++x) {
            // Rows beside one another slide by as much against each other.
            const double dx = spacing * (x + slid * y);
            const double dy = spacing * y;
            const double dz = spacing * z;
            const double square = dx * dx + dy * dy + dz * dz;
            const double distance = std::sqrt(square);
            if (distance == 0 || distance >= support) continue;
            const double slope = -kernelSlope<Kernel>(distance, support, dimensions) / distance;
            sum += dx * dx * dy * dy * slope / (square + 0.01 * support * support);
          }
        }
      }
    }
    return (dimensions + 2) * particleVolume(kernel, spacing, support, dimensions) * sum / kOffsets;
  });
}

double pressureStiffness(KernelKind kernel, double spacing, double support, int dimensions) {
  using Vector = std::array<double, 3>;
  struct Neighbour {
    std::array<int, 3> place;
    Vector gradient;
  };
  std::vector<Neighbour> neighbours;
  double diagonal = 0;
  withKernel(kernel, [&]<class Kernel>(Kernel) {
    const int reach = static_cast<int>(std::ceil(support / spacing));
    const int reachInZ = dimensions == 2 ? 0 : reach;
    for (int z = -reachInZ; z <= reachInZ; ++z) {
      for (int y = -reach; y <= reach; ++y) {
        for (int x = -reach; x <= reach; ++x) {
          const double distance = std::sqrt(static_cast<double>(x * x + y * y + z * z));
          const double slope = Kernel::slope(distance * spacing / support);
          if (slope == 0) continue;
          const double perStep = slope / distance;
          neighbours.push_back({{x, y, z}, {perStep * x, perStep * y, perStep * z}});
          diagonal += slope * slope;
        }
      }
    }
  });
  // A wave of pressure with k half turns in kSteps spacings has as eigenvalue |Σ_j ∇W_ij sin(k·x_ij)|². By symmetry,
  // k_x ≥ k_y ≥ k_z ≥ 0.
  constexpr int kSteps = 16;
  double largest = 0;
  for (int kx = 0; kx <= kSteps; ++kx) {
    for (int ky = 0; ky <= kx; ++ky) {
      for (int kz = 0; kz <= (dimensions == 2 ? 0 : ky); ++kz) {
        Vector sum{};
        for (const auto& [place, gradient] : neighbours) {
          const int phase = kx * place[0] + ky * place[1] + kz * place[2];
          const double wave = std::sin(std::numbers::pi * phase / kSteps);
          for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += gradient[axis] * wave;
        }
        largest = std::max(largest, sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
      }
    }
  }
  return largest / diagonal;
}

}  // namespace sluice::sim
