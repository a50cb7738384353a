#include "mixture.h"

#include <algorithm>

#include "sluice/core/check.h"

namespace sluice::sim {

Mixture::Mixture(const v1::Simulation& simulation) : viscousFactor_(simulation.planar() ? 8 : 10) {
  SLUICE_CHECK(simulation.fluids_size() <= static_cast<int>(kMostFluids));
  for (const v1::Fluid& fluid : simulation.fluids()) restDensities_.push_back(fluid.rest_density());
  setViscosities(simulation);
}

void Mixture::setViscosities(const v1::Simulation& simulation) {
  viscosities_.clear();
  for (const v1::Fluid& fluid : simulation.fluids()) viscosities_.push_back(fluid.viscosity());
  SLUICE_CHECK_EQ(viscosities_.size(), restDensities_.size());
}

double Mixture::heaviest() const { return *std::ranges::max_element(restDensities_); }

double Mixture::lightest() const { return *std::ranges::min_element(restDensities_); }

double Mixture::densityRatio() const { return heaviest() / lightest(); }

Mobility Mixture::mobility(const std::vector<std::uint8_t>& fluid) const {
  Mobility mobility;
  if (densityRatio() == 1) return mobility;
  mobility.fluid = fluid.data();
  for (std::size_t f = 0; f < restDensities_.size(); ++f) {
    mobility.ofFluid[f] = static_cast<float>(heaviest() / restDensities_[f]);
  }
  return mobility;
}

PairStrength Mixture::friction(const std::vector<std::uint8_t>& fluid, double seconds) const {
  PairStrength friction;
  const auto alike = [&](double viscosity) { return viscosity == viscosities_.front(); };
  if (densityRatio() == 1 && std::ranges::all_of(viscosities_, alike)) {
    friction.strength[0][0] = static_cast<float>(viscousFactor_ * viscosities_.front() * seconds);
    return friction;
  }
  friction.fluid = fluid.data();
  for (std::size_t a = 0; a < viscosities_.size(); ++a) {
    for (std::size_t b = 0; b < viscosities_.size(); ++b) {
      friction.strength[a][b] = static_cast<float>(viscousFactor_ * felt(a, b) * seconds);
    }
  }
  return friction;
}

PairStrength Mixture::withinFluids(const std::vector<std::uint8_t>& fluid, double strength) const {
  PairStrength within;
  if (several()) within.fluid = fluid.data();
  for (std::size_t f = 0; f < restDensities_.size(); ++f) within.strength[f][f] = static_cast<float>(strength);
  return within;
}

PairStrength Mixture::withinFluidsByDensity(const std::vector<std::uint8_t>& fluid, double force) const {
  PairStrength within;
  if (several()) within.fluid = fluid.data();
  for (std::size_t f = 0; f < restDensities_.size(); ++f) {
    within.strength[f][f] = static_cast<float>(force / restDensities_[f]);
  }
  return within;
}

double Mixture::felt(std::size_t a, std::size_t b) const {
  if (a == b) return viscosities_[a];
  const double own = viscosities_[a] * restDensities_[a];
  const double other = viscosities_[b] * restDensities_[b];
  return own > 0 && other > 0 ? 2 * own * other / (own + other) / restDensities_[a] : 0;
}

double Mixture::largestViscosity() const {
  double largest = 0;
  for (std::size_t a = 0; a < viscosities_.size(); ++a) {
    for (std::size_t b = 0; b < viscosities_.size(); ++b) largest = std::max(largest, felt(a, b));
  }
  return largest;
}

}  // namespace sluice::sim
