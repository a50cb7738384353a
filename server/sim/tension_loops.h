#pragma once

// Loops of surface tension. Included by pair_loops_impl.h alone, once for each instruction set.

#include "pair_lanes.h"

namespace sluice::sim {
namespace {

void cohere(const PairList& list, const PairScale& scale, const Cohesion& cohesion, const Float4* positionAndDensity,
            const Float4* normal, const Float4* velocity, Float4* result) {
  const float inverseSupport = 1 / scale.support;
  // Below this distance two particles have no direction between them.
  const Lanes tiny = splat(1e-6F * scale.support);
  const PairStrength& strength = cohesion.strength;
  const PairGroup* group = list.groups;
  for (std::uint32_t i = list.first; i < list.last; ++i) {
    const Lanes4 xi = load<Lanes4>(positionAndDensity + i);
    const Lanes4 ni = load<Lanes4>(normal + i);
    const Lanes x4 = join(xi, xi, xi, xi);
    const Lanes n4 = join(ni, ni, ni, ni);
    const bool several = strength.fluid != nullptr;
    const float* felt = strength.strength[several ? strength.fluid[i] : 0].data();
    Lanes sum{};
    for (const PairGroup* end = group + list.groupCount[i]; group != end; ++group) {
      const Lanes xj = ofNeighbours(positionAndDensity, *group);
      const Lanes xij = toNearestImage(withoutFourth(x4 - xj), scale);
      const Lanes distance = squareRoot(sumWithinQuarters(xij * xij));
      const Lanes q = distance * inverseSupport;
      const Lanes cubes = positivePart(1.0F - q) * q;
      const Lanes cubed = cubes * cubes * cubes;
      const Lanes attraction = q > 0.5F ? cubed : 2.0F * cubed - 1.0F / 64;
      Lanes correction = 2.0F / spreadLane<3>(x4 + xj);
      if (several) correction *= byFluid(strength.fluid, felt, *group);
      const Lanes perMetre = distance > tiny ? attraction / distance : Lanes{};
      sum += correction * (perMetre * xij + cohesion.curvature * (n4 - ofNeighbours(normal, *group)));
    }
    store(result + i, load<Lanes4>(velocity + i) - sumQuarters(sum) * (several ? 1.0F : *felt));
  }
}

}  // namespace
}  // namespace sluice::sim
