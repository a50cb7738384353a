#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "pair_loops.h"
#include "sluice/v1/scene.pb.h"

namespace sluice::sim {

/// What the fluids of a scene differ in, as the pair loops take it.
///
/// A particle of any fluid stands for the same volume V, so that its density relative to rest is a count of volumes and
/// does not jump where fluids of different rest density meet [Solenthaler & Pajarola 2008]. Their masses ρ0 V differ,
/// and with them how far one pressure impulse moves them: impulses κ are pressure times time over the *heaviest* rest
/// density ρ_max, and a particle answers to them with w = ρ_max/ρ0 ≥ 1. Force and counterforce then are the same
/// κ_i + κ_j, and momentum is kept between particles of unequal mass.
class Mixture {
 public:
  explicit Mixture(const v1::Simulation& simulation);

  /// Several fluids: particles carry an index.
  bool several() const { return restDensities_.size() > 1; }

  const std::vector<double>& restDensities() const { return restDensities_; }  ///< kg/m³.
  /// Of the i-th particle, kg/m³.
  double restDensityOf(const std::vector<std::uint8_t>& fluid, std::size_t i) const {
    return restDensities_[fluid.empty() ? 0 : fluid[i]];
  }
  double heaviest() const;      ///< ρ_max, kg/m³.
  double lightest() const;      ///< kg/m³.
  double densityRatio() const;  ///< Heaviest over lightest.

  /// w of particles of the given fluids; of none where all fluids weigh the same.
  Mobility mobility(const std::vector<std::uint8_t>& fluid) const;

  /// Friction between particles of the given fluids over `seconds`. Per pair of fluids it acts with the harmonic mean
  /// of the dynamic viscosities μ = ν ρ0, which makes the shear stress the same on both sides of where they meet
  /// [Hu & Adams 2006]; a fluid without viscosity slides along any other.
  PairStrength friction(const std::vector<std::uint8_t>& fluid, double seconds) const;

  /// Strength between particles of one fluid, none between those of different ones.
  PairStrength withinFluids(const std::vector<std::uint8_t>& fluid, double strength) const;

  /// Likewise, in inverse proportion to the fluid's rest density: accelerations by one force per volume.
  PairStrength withinFluidsByDensity(const std::vector<std::uint8_t>& fluid, double force) const;

  /// The largest kinematic viscosity that acts on any particle, m²/s: up to twice a fluid's own where a light fluid
  /// meets a heavy, viscous one.
  double largestViscosity() const;

  /// Live fields of a scene with the same fluids.
  void setViscosities(const v1::Simulation& simulation);

 private:
  /// μ_ab/ρ0_a, m²/s: what a particle of fluid `a` feels of one of fluid `b`.
  double felt(std::size_t a, std::size_t b) const;

  double viscousFactor_;  ///< 2(D + 2).
  std::vector<double> restDensities_;
  std::vector<double> viscosities_;
};

}  // namespace sluice::sim
