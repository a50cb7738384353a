#pragma once

// Loops of viscosity, and of diffusion, which has the same form. Included by pair_loops_impl.h alone, once for each
// instruction set.

#include "pair_lanes.h"

namespace sluice::sim {
namespace {

template <bool kSeveral>
SLUICE_INLINE void applyViscosityOf(const PairList& list, const PairScale& scale, const PairStrength& friction,
                                    const Float4* position, const Float4* velocity, Float4* result) {
  const Lanes softening = splat(0.01F * scale.support * scale.support);
  const PairGroup* group = list.groups;
  for (std::uint32_t i = list.first; i < list.last; ++i) {
    const Lanes4 xi = load<Lanes4>(position + i);
    const Lanes4 vi = load<Lanes4>(velocity + i);
    const Lanes x4 = join(xi, xi, xi, xi);
    const Lanes v4 = join(vi, vi, vi, vi);
    const float* strength = friction.strength[0].data();
    if constexpr (kSeveral) strength = friction.strength[friction.fluid[i]].data();
    Lanes sum{};
    for (const PairGroup* end = group + list.groupCount[i]; group != end; ++group) {
      const Lanes xij = toNearestImage(x4 - ofNeighbours(position, *group), scale);
      Lanes approach = sumWithinQuarters((v4 - ofNeighbours(velocity, *group)) * gradients(*group));
      if constexpr (kSeveral) approach *= byFluid(friction.fluid, strength, *group);
      sum += approach / (sumWithinQuarters(xij * xij) + softening) * xij;
    }
    store(result + i, vi + sumQuarters(sum) * (kSeveral ? list.quantum : *strength * list.quantum));
  }
}

void applyViscosity(const PairList& list, const PairScale& scale, const PairStrength& friction, const Float4* position,
                    const Float4* velocity, Float4* result) {
  if (friction.fluid == nullptr) {
    applyViscosityOf<false>(list, scale, friction, position, velocity, result);
  } else {
    applyViscosityOf<true>(list, scale, friction, position, velocity, result);
  }
}

void viscosityBlocks(const PairList& list, const PairScale& scale, const PairStrength& strength, const Float4* position,
                     Float4* columns) {
  const Lanes softening = splat(0.01F * scale.support * scale.support);
  const PairGroup* group = list.groups;
  for (std::uint32_t i = list.first; i < list.last; ++i) {
    const Lanes4 xi = load<Lanes4>(position + i);
    const Lanes x4 = join(xi, xi, xi, xi);
    const bool several = strength.fluid != nullptr;
    const float* felt = strength.strength[several ? strength.fluid[i] : 0].data();
    Lanes sums[3]{};
    for (const PairGroup* end = group + list.groupCount[i]; group != end; ++group) {
      const Lanes xij = toNearestImage(x4 - ofNeighbours(position, *group), scale);
      const Lanes share = several ? byFluid(strength.fluid, felt, *group) : splat(*felt);
      const Lanes scaled = share / (sumWithinQuarters(xij * xij) + softening) * xij;
      const Lanes gradient = gradients(*group);
      sums[0] += scaled * spreadLane<0>(gradient);
      sums[1] += scaled * spreadLane<1>(gradient);
      sums[2] += scaled * spreadLane<2>(gradient);
    }
    for (int column = 0; column < 3; ++column) {
      store(columns + 3 * std::size_t{i} + column, sumQuarters(sums[column]) * list.quantum);
    }
  }
}

void diffuse(const PairList& list, const PairScale& scale, const PairStrength& strength, const Float4* positionAndValue,
             float* result) {
  const Lanes softening = splat(0.01F * scale.support * scale.support);
  const PairGroup* group = list.groups;
  for (std::uint32_t i = list.first; i < list.last; ++i) {
    const Lanes4 xi = load<Lanes4>(positionAndValue + i);
    const Lanes x4 = join(xi, xi, xi, xi);
    const bool several = strength.fluid != nullptr;
    const float* felt = strength.strength[several ? strength.fluid[i] : 0].data();
    Lanes sum{};
    for (const PairGroup* end = group + list.groupCount[i]; group != end; ++group) {
      const Lanes difference = toNearestImage(x4 - ofNeighbours(positionAndValue, *group), scale);
      const Lanes xij = withoutFourth(difference);
      Lanes share = sumWithinQuarters(xij * gradients(*group)) / (sumWithinQuarters(xij * xij) + softening);
      if (several) share *= byFluid(strength.fluid, felt, *group);
      sum += share * difference;
    }
    result[i] = sumQuarters(sum)[3] * (several ? list.quantum : *felt * list.quantum);
  }
}

}  // namespace
}  // namespace sluice::sim
