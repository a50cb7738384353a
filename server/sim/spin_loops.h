#pragma once

// The loop of micropolar fluids. Included by pair_loops_impl.h alone, once for each instruction set.

#include "pair_lanes.h"

namespace sluice::sim {
namespace {

template <class Kernel>
SLUICE_INLINE void exchangeSpinOf(const PairList& list, const PairScale& scale, const SpinExchange& exchange,
                                  const Float4* position, const Float4* velocity, const Float4* spin,
                                  Float4* velocityResult, Float4* spinResult) {
  const float inverseSupport = 1 / scale.support;
  const float smoothing = exchange.smoothing * scale.value;
  const float damping = 1 / (1 + 2 * exchange.spinUp);
  const PairGroup* group = list.groups;
  for (std::uint32_t i = list.first; i < list.last; ++i) {
    const Lanes4 xi = load<Lanes4>(position + i);
    const Lanes4 vi = load<Lanes4>(velocity + i);
    const Lanes4 wi = load<Lanes4>(spin + i);
    const Lanes x4 = join(xi, xi, xi, xi);
    const Lanes v4 = join(vi, vi, vi, vi);
    const Lanes w4 = join(wi, wi, wi, wi);
    Lanes push{}, curl{}, difference{};
    for (const PairGroup* end = group + list.groupCount[i]; group != end; ++group) {
      const Lanes gradient = gradients(*group);
      const Lanes wj = ofNeighbours(spin, *group);
      push += cross(w4 + wj, gradient);
      curl += cross(v4 - ofNeighbours(velocity, *group), gradient);
      const Lanes xij = toNearestImage(x4 - ofNeighbours(position, *group), scale);
      difference += Kernel::value(squareRoot(sumWithinQuarters(xij * xij)) * inverseSupport) * (w4 - wj);
    }
    store(velocityResult + i, vi - sumQuarters(push) * (exchange.transfer * list.quantum));
    const Lanes4 change = sumQuarters(curl) * (exchange.spinUp * list.quantum) - sumQuarters(difference) * smoothing;
    store(spinResult + i, (wi + change) * damping);
  }
}

void exchangeSpin(const PairList& list, const PairScale& scale, const SpinExchange& exchange, const Float4* position,
                  const Float4* velocity, const Float4* spin, Float4* velocityResult, Float4* spinResult) {
  switch (scale.kernel) {
    case KernelKind::WendlandC2:
      return exchangeSpinOf<WendlandC2>(list, scale, exchange, position, velocity, spin, velocityResult, spinResult);
    case KernelKind::CubicSpline:
      break;
  }
  exchangeSpinOf<CubicSpline>(list, scale, exchange, position, velocity, spin, velocityResult, spinResult);
}

}  // namespace
}  // namespace sluice::sim
