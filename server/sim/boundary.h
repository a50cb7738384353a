#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bodies.h"
#include "cell_grid.h"
#include "container.h"
#include "discretisation.h"
#include "particles.h"

namespace sluice::sim {

/// Layers of boundary particles that the support reaches into from where the lowest layer of fluid lies, one spacing
/// above the face: with fewer, a wide kernel would feel too little of a wall to stay away from it.
int boundaryLayers(const Discretisation& discretisation);

/// γ: what the lowest layer of a lattice over a wall lacks, over what a wall of particles with γ = 1 would give it. The
/// wall is a lattice of the same spacing, `layers` thick; the mean over where the fluid stands above it.
double wallCalibration(const Discretisation& discretisation, int layers);

/// V_b over the volume of a fluid particle in each layer of such a wall, the outermost first.
std::vector<double> wallVolumes(const Discretisation& discretisation, int layers);

/// Points of the faces of a lattice that fills the container's box, and of layers - 1 shells around it.
std::vector<Float4> sampleBox(const Container& container, double spacing, int layers);

/// Boundary particles on the container's inner faces and the bodies' surfaces, Akinci et al. 2012: each carries
/// the pseudo-volume V_b = γ / Σ_k W_bk over the boundary particles around it, so that densely and sparsely sampled
/// places count alike. γ makes up for there being few layers of them, one for
/// supports of up to two spacings, behind one another for wider ones: it is chosen so that a lattice of fluid whose
/// lowest layer lies one spacing from a face has exactly the rest density there. A planar scene has them on four edges.
/// Where a body stands on a face, or two touch, all are counted together, so that a joint weighs no more than a face.
class Boundary {
 public:
  /// The container's faces and planes.
  static constexpr std::uint8_t kContainerSurface = 0;

  Boundary(const Container& container, const Bodies& bodies, const Discretisation& discretisation,
           const CellGeometry& geometry, const Team& team);

  /// Particles that the container would be sampled with, before any are made.
  static double expectedCount(const Container& container, const Discretisation& discretisation);

  std::size_t size() const { return points_.size(); }

  /// In the order of grid().
  const std::vector<Float4>& points() const { return points_; }
  const std::vector<float>& volumes() const { return volumes_; }  ///< V_b over the volume of a fluid particle.
  /// What each lies on: kContainerSurface, or 1 + k for the k-th of the Bodies.
  const std::vector<std::uint8_t>& surfaces() const { return surfaces_; }
  const CellGrid& grid() const { return grid_; }

 private:
  CellGrid grid_;
  std::vector<Float4> points_;
  std::vector<float> volumes_;
  std::vector<std::uint8_t> surfaces_;
};

}  // namespace sluice::sim
