#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "sluice/v1/scene.pb.h"

namespace sluice::render {

/// The points x with (x−c)ᵀ S⁻¹ (x−c) ≤ 1. S is symmetric; its eigenvalues are the squares of the half axes.
struct SplatEllipsoid {
  Eigen::Vector3f centre;    ///< c, m.
  Eigen::Vector3f diagonal;  ///< S_xx, S_yy, S_zz, m².
  Eigen::Vector3f mixed;     ///< S_xy, S_xz, S_yz, m².
  float shortest = 0;        ///< Half axes, m.
  float longest = 0;

  Eigen::Matrix3f squares() const;
};

/// Ellipsoids that lie along the particles' neighbours [YT13: Yu & Turk 2013, Reconstructing surfaces of particle-based
/// fluids using anisotropic kernels]. The weighted covariance of a particle's neighbourhood, C = Σ w (x_j − x̄)(x_j −
/// x̄)ᵀ/Σ w with w = 1 − (|x_ij|/ρ)³, gives axes and directions: half axes are R·σ_k/σ, where σ_k are the eigenvalues of
/// C, none less than the largest over `largest_stretch`, and σ is what they are in endless liquid, so that particles
/// deep inside become balls of radius R. A particle is drawn towards x̄. With too few neighbours it is a ball of its own
/// volume, or of R if that is less, and stays where it is.
///
/// `radii` holds R of every particle, or nothing for `radius` throughout. Uses the OpenMP team of the calling thread;
/// the result is the same for any number of threads.
std::vector<SplatEllipsoid> makeEllipsoids(std::span<const Eigen::Vector3f> positions, float spacing, float radius,
                                           std::span<const float> radii, const v1::Ellipsoid& settings);

}  // namespace sluice::render
