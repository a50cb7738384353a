#include "lattice.h"

#include <cmath>

namespace sluice::sim {

namespace {

/// Σ d³ W over the lattice points with index z ≥ lowest.
double latticeSum(KernelKind kind, double spacing, double support, int lowest) {
  return withKernel(kind, [&]<class Kernel>(Kernel) {
    const int reach = static_cast<int>(std::ceil(support / spacing));
    double sum = 0;
    for (int z = lowest < -reach ? -reach : lowest; z <= reach; ++z) {
      for (int y = -reach; y <= reach; ++y) {
        for (int x = -reach; x <= reach; ++x) {
          const double distance = spacing * std::sqrt(static_cast<double>(x * x + y * y + z * z));
          sum += kernelValue<Kernel>(distance, support);
        }
      }
    }
    return sum * spacing * spacing * spacing;
  });
}

constexpr int kEverywhere = -1000;

}  // namespace

double latticeDensity(KernelKind kernel, double spacing, double support) {
  return latticeSum(kernel, spacing, support, kEverywhere);
}

double particleVolume(KernelKind kernel, double spacing, double support) {
  return spacing * spacing * spacing / latticeDensity(kernel, spacing, support);
}

double halfSpaceDensity(KernelKind kernel, double spacing, double support) {
  return latticeSum(kernel, spacing, support, 0) / latticeDensity(kernel, spacing, support);
}

}  // namespace sluice::sim
