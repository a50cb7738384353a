#pragma once

#include <vector>

#include <Eigen/Core>

#include "foam_grid.h"
#include "foam_sums.h"
#include "foam_walls.h"

namespace sluice::sources {

/// What the flow is measured by, so that neither rates nor limits depend on the resolution.
struct FoamScales {
  float spacing = 0;  ///< d, m.
  float support = 0;  ///< h = 2 d, m.
  float length = 0;   ///< L: edge of a cube of all the liquid, m.
  float speed = 0;    ///< U = √(gL), m/s: what falling by half of L gives.
};

/// `gravity` is g, m/s²; where there is none, that of the earth still tells which speeds are high.
FoamScales foamScales(std::size_t particles, double spacing, double gravity);

/// Factors of the two rates; 0 leaves a potential out.
struct FoamRates {
  float trappedAir = 0;
  float waveCrests = 0;
};

/// Where secondary particles come from: the potentials of [Ihmsen et al. 2012, Unified spray, foam and air bubbles] for
/// trapped air, wave crests, and kinetic energy, made independent of the resolution.
///
/// - Their limits on Σ|v_ij|(1 - v̂_ij·x̂_ij)W, m/s, and on ½mv² become shares of U and of ½ρ0 gL: the first sum is
/// divided
///   by ΣW inside the liquid, the second is taken per volume.
/// - Liquid that collides does so within a layer whose thickness follows h, so a rate per particle would let foam
///   vanish as h does; trapped air is therefore made at the rate U/h. Crests are lines, which the particles within h
///   of them stand for: their rate is UL/h².
///
/// What is made then has a volume in proportion to d³, and as many particles per volume of liquid as that allows.
class FoamPotentials {
 public:
  /// Secondary particles per second that each particle of the grid makes, in its order.
  const std::vector<float>& rates() const { return rates_; }
  /// Neighbours of those that make any, as if walls were liquid.
  const std::vector<float>& neighbours() const { return neighbours_; }

  /// Gives the same bits for any number of threads.
  void compute(const LiquidGrid& grid, const FoamWalls& walls, const FoamScales& scales, const FoamRates& rates,
               int threads);

 private:
  void findFast(const LiquidGrid& grid, const FoamScales& scales);
  void computeMotion(const LiquidGrid& grid, const FoamWalls& walls, const FoamScales& scales, const FoamRates& rates,
                     int threads);
  void computeCrests(const LiquidGrid& grid, const FoamScales& scales, const FoamRates& rates, int threads);

  std::vector<float> energy_;         ///< Φ of the kinetic energy.
  std::vector<std::uint32_t> cells_;  ///< With a particle that is fast enough,
  std::vector<std::uint32_t> reach_;  ///< and those around them.
  std::vector<float> rates_;
  std::vector<float> neighbours_;
  NearbyNormals normals_;  ///< Of every particle in reach; 0 off the surface.
};

}  // namespace sluice::sources
