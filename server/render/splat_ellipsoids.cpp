#include "splat_ellipsoids.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "particle_grid.h"
#include "splat_model.h"

namespace sluice::render {

namespace {

/// Weighted moments of the places of neighbours, relative to the particle, m. The particle counts as one.
struct Neighbourhood {
  float weight = 0;
  Eigen::Vector3f first = Eigen::Vector3f::Zero();
  Eigen::Vector3f diagonal = Eigen::Vector3f::Zero();  ///< Of the second moments: xx, yy, zz.
  Eigen::Vector3f mixed = Eigen::Vector3f::Zero();     ///< xy, xz, yz.
  std::uint32_t others = 0;

  void add(const Eigen::Vector3f& r, float squaredDistance, float inverseReach) {
    const float q = std::sqrt(squaredDistance) * inverseReach;
    const float w = 1.0F - q * q * q;  // w_ij [YT13]
    const Eigen::Vector3f weighted = w * r;
    weight += w;
    first += weighted;
    diagonal += weighted.cwiseProduct(r);
    mixed += Eigen::Vector3f(weighted.x() * r.y(), weighted.x() * r.z(), weighted.y() * r.z());
    ++others;
  }

  Eigen::Vector3f mean() const { return first / weight; }

  Eigen::Matrix3d covariance() const {
    const Eigen::Vector3d m = mean().cast<double>();
    const Eigen::Vector3d d = (diagonal / weight).cast<double>();
    const Eigen::Vector3d o = (mixed / weight).cast<double>();
    Eigen::Matrix3d c;
    c << d.x(), o.x(), o.y(), o.x(), d.y(), o.z(), o.y(), o.z(), d.z();
    return c - m * m.transpose();
  }
};

/// Eigenvalues of the covariance in a liquid without end, over ρ²: (∫ w r² dV)/(3 ∫ w dV) with w = 1 − (r/ρ)³. In a
/// cubic lattice they are up to 4 % more or less, depending on ρ/d; the disorder of a liquid evens that out.
constexpr double kBulkVariance = 0.15;

SplatEllipsoid ball(const Eigen::Vector3f& centre, float radius) {
  return {centre, Eigen::Vector3f::Constant(radius * radius), Eigen::Vector3f::Zero(), radius, radius};
}

SplatEllipsoid along(const Eigen::Vector3f& centre, const Eigen::Matrix3d& covariance, double radiusPerVariance,
                     double largestStretch) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(covariance);
  const double largest = solver.eigenvalues()(2);
  const Eigen::Vector3d variances = solver.eigenvalues().cwiseMax(largest / largestStretch);  // σ̃_k [YT13]
  const Eigen::Vector3d axes = radiusPerVariance * variances;
  const Eigen::Matrix3d& directions = solver.eigenvectors();
  const Eigen::Matrix3d squares = directions * axes.cwiseAbs2().asDiagonal() * directions.transpose();
  SplatEllipsoid result;
  result.centre = centre;
  result.diagonal = squares.diagonal().cast<float>();
  result.mixed = Eigen::Vector3d(squares(0, 1), squares(0, 2), squares(1, 2)).cast<float>();
  result.shortest = static_cast<float>(axes(0));
  result.longest = static_cast<float>(axes(2));
  return result;
}

}  // namespace

Eigen::Matrix3f SplatEllipsoid::squares() const {
  Eigen::Matrix3f s;
  s << diagonal.x(), mixed.x(), mixed.y(), mixed.x(), diagonal.y(), mixed.z(), mixed.y(), mixed.z(), diagonal.z();
  return s;
}

std::vector<SplatEllipsoid> makeEllipsoids(std::span<const Eigen::Vector3f> positions, float spacing, float radius,
                                           std::span<const float> radii, const v1::Ellipsoid& settings) {
  const auto reach = static_cast<float>(settings.neighbourhood_in_spacings() * spacing);
  const float inverseReach = 1.0F / reach;
  const auto pull = static_cast<float>(settings.position_smoothing());
  const double perVariance = 1.0 / (kBulkVariance * reach * reach);
  // Coincident particles have no extent of their own.
  const double leastVariance = 1e-6 / perVariance;

  const ParticleGrid grid(positions, reach);
  std::vector<SplatEllipsoid> ellipsoids(positions.size());
  const auto count = static_cast<std::ptrdiff_t>(positions.size());
#pragma omp parallel for schedule(dynamic, 256)
  for (std::ptrdiff_t k = 0; k < count; ++k) {
    const auto place = static_cast<std::size_t>(k);
    const std::size_t i = grid.order()[place];
    const Eigen::Vector3f& centre = grid.points()[place];
    const float own = radii.empty() ? radius : radii[i];
    Neighbourhood around;
    around.weight = 1;
    grid.forEachAround(centre, [&](std::uint32_t j) {
      const Eigen::Vector3f r = grid.points()[j] - centre;
      const float squaredDistance = r.squaredNorm();
      if (squaredDistance < reach * reach && j != place) around.add(r, squaredDistance, inverseReach);
    });
    const Eigen::Matrix3d covariance = around.covariance();
    if (around.others < settings.least_neighbours() || covariance.trace() <= leastVariance) {
      ellipsoids[i] = ball(centre, std::min(own, kBallOfParticle * spacing));
    } else {
      ellipsoids[i] = along(centre + pull * around.mean(), covariance, own * perVariance, settings.largest_stretch());
    }
  }
  return ellipsoids;
}

}  // namespace sluice::render
