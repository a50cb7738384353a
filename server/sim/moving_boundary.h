#pragma once

#include <cstdint>
#include <vector>

#include "boundary.h"
#include "cell_grid.h"
#include "moving_bodies.h"
#include "particles.h"
#include "team.h"

namespace sluice::sim {

/// Boundary particles of the bodies that move, Akinci et al. 2012: they are where their bodies are, and are sorted anew
/// in every step. Each counts those around it on its own body, on other moving ones and on what stands; what stands
/// does not count them.
class MovingBoundary {
 public:
  MovingBoundary() = default;
  MovingBoundary(const MovingBodies& bodies, const Discretisation& discretisation, const CellGeometry& geometry,
                 int layers);

  /// Takes the samples along with their bodies.
  void update(const MovingBodies& bodies, const Boundary& standing, const Team& team);

  std::size_t size() const { return points_.size(); }

  /// In the order of grid().
  const CellGrid& grid() const { return grid_; }
  const std::vector<Float4>& points() const { return points_; }
  const std::vector<float>& volumes() const { return volumes_; }  ///< V_b over the volume of a fluid particle.
  const std::vector<std::uint8_t>& bodyOf() const { return body_; }

  std::uint64_t bytes() const;

 private:
  struct Sample {
    Eigen::Vector3d own;  ///< In its body's axes.
    std::uint8_t body;
    double ownSum;       ///< Σ_k W_bk over its own body, 1/m³.
    double calibration;  ///< γ.
  };

  Discretisation discretisation_;
  std::vector<Sample> samples_;
  CellGrid grid_;
  std::vector<Float4> unsorted_;
  std::vector<Float4> points_;
  std::vector<float> volumes_;
  std::vector<std::uint8_t> body_;
};

}  // namespace sluice::sim
