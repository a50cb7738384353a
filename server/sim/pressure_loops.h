#pragma once

// Loops of the pressure solvers. Included by pair_loops_impl.h alone, once for each instruction set.

#include "pair_lanes.h"

namespace sluice::sim {
namespace {

void weighSquares(const PairList& list, const Mobility& mobility, float* result) {
  const PairGroup* group = list.groups;
  for (std::uint32_t i = list.first; i < list.last; ++i) {
    Lanes sum{};
    for (const PairGroup* end = group + list.groupCount[i]; group != end; ++group) {
      const Lanes gradient = gradients(*group);
      sum += byFluid(mobility.fluid, mobility.ofFluid.data(), *group) * (gradient * gradient);
    }
    result[i] = sumLanes(sum) * (list.quantum * list.quantum);
  }
}

template <bool kUnequal>
SLUICE_INLINE void applyImpulsesTo(const PairList& list, const Mobility& mobility, const Float4* impulse,
                                   const Float4* gradientSum, const Float4* velocity, Float4* result) {
  const PairGroup* group = list.groups;
  for (std::uint32_t i = list.first; i < list.last; ++i) {
    const Lanes4 sum = sumOverPairs(group, list.groupCount[i], impulse) * list.quantum;
    Lanes4 change = load<Lanes4>(impulse + i) * load<Lanes4>(gradientSum + i) + sum;
    if constexpr (kUnequal) change *= mobility.ofFluid[mobility.fluid[i]];
    store(result + i, load<Lanes4>(velocity + i) - change);
  }
}

void applyImpulses(const PairList& list, const Mobility& mobility, const Float4* impulse, const Float4* gradientSum,
                   const Float4* velocity, Float4* result) {
  if (mobility.fluid == nullptr) {
    applyImpulsesTo<false>(list, mobility, impulse, gradientSum, velocity, result);
  } else {
    applyImpulsesTo<true>(list, mobility, impulse, gradientSum, velocity, result);
  }
}

SolveError relaxImpulses(const PairList& list, const Float4* velocity, const Float4* gradientSum, const float* factor,
                         const float* density, float seconds, float relaxation, Float4* impulse) {
  const float perSecond = 1 / seconds;
  const PairGroup* group = list.groups;
  SolveError error;
  for (std::uint32_t i = list.first; i < list.last; ++i) {
    const Lanes4 sum = sumOverPairs(group, list.groupCount[i], velocity) * list.quantum;
    const Lanes4 terms = load<Lanes4>(velocity + i) * load<Lanes4>(gradientSum + i) - sum;
    const float excess = sumLanes(terms) - (density != nullptr ? (1.0F - density[i]) * perSecond : 0.0F);
    const float relaxed = impulse[i].x + relaxation * factor[i] * excess;
    const float next = factor[i] > 0.0F && relaxed > 0.0F ? relaxed : 0.0F;
    impulse[i] = {next, next, next, next};
    const float compression = factor[i] > 0.0F && excess > 0.0F ? excess * seconds : 0.0F;
    error.sum += static_cast<double>(compression);
    error.largest = compression > error.largest ? compression : error.largest;
  }
  return error;
}

void densityRate(const PairList& list, const Float4* velocity, const Float4* gradientSum, float* rate) {
  const PairGroup* group = list.groups;
  for (std::uint32_t i = list.first; i < list.last; ++i) {
    const Lanes4 sum = sumOverPairs(group, list.groupCount[i], velocity) * list.quantum;
    rate[i] = sumLanes(load<Lanes4>(velocity + i) * load<Lanes4>(gradientSum + i) - sum);
  }
}

void weightedGradient(const PairList& list, const Float4* weight, Float4* result) {
  const PairGroup* group = list.groups;
  for (std::uint32_t i = list.first; i < list.last; ++i) {
    store(result + i, sumOverPairs(group, list.groupCount[i], weight) * list.quantum);
  }
}

}  // namespace
}  // namespace sluice::sim
