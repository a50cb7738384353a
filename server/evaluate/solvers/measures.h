#pragma once

#include <vector>

#include <Eigen/Core>

#include "sluice/core/particle_snapshot.h"

namespace sluice::evaluate {

/// √(Σ (a-b)² / Σ b²): the relative L2 norm of particles of equal volume.
class RelativeL2 {
 public:
  void add(double value, double exact) {
    difference_ += (value - exact) * (value - exact);
    square_ += exact * exact;
  }
  double value() const;

 private:
  double difference_ = 0;
  double square_ = 0;
};

/// Means of a cloud of equal particles in the plane.
struct PlaneMoments {
  double xx = 0, yy = 0, xy = 0;                       ///< About the centre of mass, m².
  double kinetic = 0;                                  ///< ½ v² per mass, m²/s².
  double spin = 0;                                     ///< Angular momentum about the centre of mass, per mass, m²/s.
  Eigen::Vector3d momentum = Eigen::Vector3d::Zero();  ///< Per mass, m/s.
};

PlaneMoments planeMoments(const core::ParticleSnapshot& particles);

/// A field that particles of equal volume carry, at the places of the particles: Σ_j a_j W_ij / Σ_j W_ij with the cubic
/// spline of two spacings [Shepard 1968]. What single particles differ by from the field, their packing makes.
std::vector<double> interpolated(const core::ParticleSnapshot& particles, const std::vector<double>& values);

/// A signal over time whose oscillation is looked for.
class Oscillation {
 public:
  void add(double time, double value);

  /// Mean distance of its crossings of `level` in the same direction, s, the first crossing left out where there are
  /// enough of them; NaN for fewer than two.
  double period(double level = 0) const;
  /// Largest and smallest value.
  double highest() const;
  double lowest() const;
  /// Largest magnitudes between crossings of 0, in order.
  std::vector<double> peaks() const;

 private:
  std::vector<double> times_;
  std::vector<double> values_;
};

/// Points of the square lattice of the spacing, with one point half a spacing from both axes, for which `inside` holds.
template <class Inside>
std::vector<Eigen::Vector3d> latticePoints(double halfWidth, double halfHeight, double spacing, Inside&& inside) {
  std::vector<Eigen::Vector3d> points;
  const int nx = static_cast<int>(halfWidth / spacing) + 1;
  const int ny = static_cast<int>(halfHeight / spacing) + 1;
  for (int j = -ny; j < ny; ++j) {
    for (int i = -nx; i < nx; ++i) {
      const Eigen::Vector3d place((i + 0.5) * spacing, (j + 0.5) * spacing, 0);
      if (inside(place)) points.push_back(place);
    }
  }
  return points;
}

}  // namespace sluice::evaluate
