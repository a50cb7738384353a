#include "pair_loops.h"

#include <limits>

namespace sluice::sim {

PairScale::PairScale(const Discretisation& discretisation, const std::array<double, 3>& size)
    : kernel(discretisation.kernel),
      periodic(size != std::array<double, 3>{}),
      period{static_cast<float>(size[0]), static_cast<float>(size[1]), static_cast<float>(size[2]), 0} {
  const auto half = [](float length) { return length > 0 ? length / 2 : std::numeric_limits<float>::infinity(); };
  halfPeriod = {half(period.x), half(period.y), half(period.z), half(0)};
  const double supportRadius = discretisation.support;
  const double volume = discretisation.volume;
  withKernel(kernel, [&]<class Kernel>(Kernel) {
    const double perVolume =
        Kernel::normalisation(discretisation.dimensions) / supportPower(supportRadius, discretisation.dimensions);
    support = static_cast<float>(supportRadius);
    value = static_cast<float>(volume * perVolume);
    slope = static_cast<float>(volume * perVolume / supportRadius);
    // The steepest gradient is the largest 16-bit integer.
    quantum = static_cast<float>(volume * perVolume / supportRadius * Kernel::kSteepestSlope /
                                 std::numeric_limits<std::int16_t>::max());
    inverseQuantum = 1 / quantum;
  });
}

extern const PairLoops kPairLoopsBaseline;
#ifdef SLUICE_WITH_X86_VARIANTS
extern const PairLoops kPairLoopsAvx2;
extern const PairLoops kPairLoopsAvx512;
#endif

std::vector<const PairLoops*> availablePairLoops() {
  std::vector<const PairLoops*> loops{&kPairLoopsBaseline};
#ifdef SLUICE_WITH_X86_VARIANTS
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi2")) loops.push_back(&kPairLoopsAvx2);
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512vl")) {
    loops.push_back(&kPairLoopsAvx512);
  }
#endif
  return loops;
}

const PairLoops& bestPairLoops() {
  static const PairLoops& best = *availablePairLoops().back();
  return best;
}

}  // namespace sluice::sim
