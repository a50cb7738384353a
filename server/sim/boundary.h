#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "cell_grid.h"
#include "kernel.h"
#include "particles.h"

namespace sluice::sim {

/// Boundary particles on the inner faces of a box whose lower corner is the origin, Akinci et al. 2012: each carries
/// the pseudo-volume V_b = γ / Σ_k W_bk over the boundary particles around it, so that densely and sparsely sampled
/// places count alike. γ makes up for there being one layer of them: it is chosen so that a lattice of fluid whose
/// lowest layer lies one spacing from a face has exactly the rest density there.
class BoxBoundary {
 public:
  /// `fluidVolume` is that of a fluid particle; volumes are kept as multiples of it.
  BoxBoundary(const std::array<double, 3>& size, double spacing, double support, KernelKind kernel, double fluidVolume,
              const CellGeometry& geometry, const Team& team);

  /// Particles that the box would be sampled with, before any are made.
  static double expectedCount(const std::array<double, 3>& size, double spacing);

  std::size_t size() const { return points_.size(); }

  /// In the order of grid().
  const std::vector<Float4>& points() const { return points_; }
  const std::vector<float>& volumes() const { return volumes_; }  ///< V_b over the volume of a fluid particle.
  const CellGrid& grid() const { return grid_; }

 private:
  CellGrid grid_;
  std::vector<Float4> points_;
  std::vector<float> volumes_;
};

}  // namespace sluice::sim
