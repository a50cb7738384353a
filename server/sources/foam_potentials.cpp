#include "foam_potentials.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace sluice::sources {

namespace {

using Eigen::Vector3f;

/// Below and above which a potential is 0 and 1.
struct Limits {
  float least;
  float most;

  /// Φ(I, τmin, τmax), Eq. (1) [Ihmsen et al. 2012].
  float phi(float value) const { return std::clamp((value - least) / (most - least), 0.0F, 1.0F); }
};

/// ΣW over a full neighbourhood: ∫(1 - r/h)dV/d³ = πh³/3d³ with h = 2d.
constexpr float kFullWeight = 8.38F;

/// Of the mean approach within h over U. Their 5 to 20 m/s are sums over such a neighbourhood, in flows of 10 m/s.
constexpr Limits kTrappedAir{0.1F, 0.4F};
/// Of the mean of 1 - n_i·n_j over the surface within h: bends by 40° and by 80°. Particles' disorder alone bends a
/// flat surface by 20°.
constexpr Limits kWaveCrest{0.25F, 0.8F};
/// Of v²/gL: what a fall by 4 % and by half of L/2 gives.
constexpr Limits kEnergy{0.08F, 0.8F};

/// Secondary particles that one particle makes while the liquid crosses h at speed U.
constexpr float kTrappedAirRate = 24.0F;
/// Likewise along crests, times h/L.
constexpr float kWaveCrestRate = 6.0F;

/// v̂_i·n̂_i from which a crest runs ahead of the liquid, Eq. (7) [Ihmsen et al. 2012].
constexpr float kForward = 0.6F;

/// |ΣW x_ij| over h·ΣW from which a particle is one of the surface; a flat one has 0.15, the inside little but noise.
constexpr float kSurface = 0.06F;

/// With fewer neighbours a particle is spray itself.
constexpr float kLeastNeighbours = 6;

}  // namespace

FoamScales foamScales(std::size_t particles, double spacing, double gravity) {
  constexpr double kOfTheEarth = 9.81;
  const double length = spacing * std::cbrt(static_cast<double>(std::max<std::size_t>(particles, 1)));
  const double speed = std::sqrt((gravity > 0 ? gravity : kOfTheEarth) * length);
  return {static_cast<float>(spacing), static_cast<float>(2 * spacing), static_cast<float>(length),
          static_cast<float>(speed)};
}

void FoamPotentials::compute(const LiquidGrid& grid, const FoamWalls& walls, const FoamScales& scales,
                             const FoamRates& rates, int threads) {
  rates_.assign(grid.size(), 0);
  neighbours_.assign(grid.size(), 0);
  findFast(grid, scales);
  if (cells_.empty()) return;
  computeMotion(grid, walls, scales, rates, threads);
  if (rates.waveCrests > 0) computeCrests(grid, scales, rates, threads);
}

/// Only fast liquid makes anything: calm cells are not looked at any further.
void FoamPotentials::findFast(const LiquidGrid& grid, const FoamScales& scales) {
  const float perSquaredSpeed = 1 / (scales.speed * scales.speed);
  energy_.resize(grid.size());
  cells_.clear();
  for (std::uint32_t cell = 0; cell < grid.cellCount(); ++cell) {
    const LiquidGrid::Range range = grid.particlesOf(cell);
    bool isFast = false;
    for (std::uint32_t i = range.first; i < range.last; ++i) {
      energy_[i] = kEnergy.phi(grid.velocity(i).squaredNorm() * perSquaredSpeed);
      isFast |= energy_[i] > 0;
    }
    if (isFast) cells_.push_back(cell);
  }
}

void FoamPotentials::computeMotion(const LiquidGrid& grid, const FoamWalls& walls, const FoamScales& scales,
                                   const FoamRates& rates, int threads) {
  // Crests compare a particle's normal with those around it, so normals are needed one cell further.
  reach_ = cells_;
  if (rates.waveCrests > 0) {
    reach_.clear();
    for (std::uint32_t cell = 0; cell < grid.cellCount(); ++cell) {
      const LiquidGrid::Range own = grid.particlesOf(cell);
      if (own.first == own.last) continue;
      const LiquidGrid::Ranges around = grid.around(cell);
      const bool inReach = std::ranges::any_of(around.all(), [&](const LiquidGrid::Range& range) {
        return std::any_of(&energy_[range.first], &energy_[range.last - 1] + 1, [](float e) { return e > 0; });
      });
      if (inReach) reach_.push_back(cell);
    }
    for (std::vector<float>* normals : {&normals_.x, &normals_.y, &normals_.z}) normals->assign(grid.size(), 0);
  }
  const auto count = static_cast<std::ptrdiff_t>(reach_.size());
#pragma omp parallel num_threads(threads)
  {
    NearbyLiquid nearby;
#pragma omp for schedule(dynamic, 16)
    for (std::ptrdiff_t c = 0; c < count; ++c) {
      const std::uint32_t cell = reach_[static_cast<std::size_t>(c)];
      grid.gather(cell, nearby);
      const LiquidGrid::Range own = grid.particlesOf(cell);
      for (std::uint32_t i = own.first; i < own.last; ++i) {
        const Vector3f position = grid.position(i);
        const MotionSums sums = sumMotion(nearby, position, grid.velocity(i), scales.support);
        const float open = walls.openShare(position, scales.support, scales.spacing);
        neighbours_[i] = (sums.count - 1) / open;
        const float approach = sums.approach / (kFullWeight * scales.speed);
        if (neighbours_[i] >= kLeastNeighbours) {
          rates_[i] = kTrappedAirRate * rates.trappedAir * scales.speed / scales.support * kTrappedAir.phi(approach) *
                      energy_[i];
        }
        if (rates.waveCrests <= 0) continue;
        const Vector3f outward = walls.withoutWalls(sums.outward, position, scales.support);
        const float length = outward.norm();
        if (length < kSurface * kFullWeight * scales.support) continue;
        normals_.x[i] = outward.x() / length;
        normals_.y[i] = outward.y() / length;
        normals_.z[i] = outward.z() / length;
      }
    }
  }
}

void FoamPotentials::computeCrests(const LiquidGrid& grid, const FoamScales& scales, const FoamRates& rates,
                                   int threads) {
  const float rate =
      kWaveCrestRate * rates.waveCrests * scales.speed * scales.length / (scales.support * scales.support);
  const auto count = static_cast<std::ptrdiff_t>(cells_.size());
#pragma omp parallel num_threads(threads)
  {
    NearbyLiquid nearby;
    NearbyNormals nearbyNormals;
#pragma omp for schedule(dynamic, 16)
    for (std::ptrdiff_t c = 0; c < count; ++c) {
      const std::uint32_t cell = cells_[static_cast<std::size_t>(c)];
      const LiquidGrid::Range own = grid.particlesOf(cell);
      bool gathered = false;
      for (std::uint32_t i = own.first; i < own.last; ++i) {
        const Vector3f normal(normals_.x[i], normals_.y[i], normals_.z[i]);
        const Vector3f velocity = grid.velocity(i);
        const bool isAhead = normal.dot(velocity) >= kForward * velocity.norm() && !normal.isZero();
        if (energy_[i] <= 0 || neighbours_[i] < kLeastNeighbours || !isAhead) continue;
        if (!std::exchange(gathered, true)) {
          grid.gather(cell, nearby);
          const auto fill = [&](const std::vector<float>& from, std::vector<float>& to) {
            to.assign(nearby.padded(), 0);
            for (std::size_t k = 0; k < nearby.particle.size(); ++k) to[k] = from[nearby.particle[k]];
          };
          fill(normals_.x, nearbyNormals.x);
          fill(normals_.y, nearbyNormals.y);
          fill(normals_.z, nearbyNormals.z);
        }
        const BendSums sums = sumBend(nearby, nearbyNormals, grid.position(i), normal, scales.support);
        rates_[i] += rate * kWaveCrest.phi(sums.bend / sums.weight) * energy_[i];
      }
    }
  }
}

}  // namespace sluice::sources
