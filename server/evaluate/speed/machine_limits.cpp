#include "speed/machine_limits.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <vector>

#include <omp.h>

#include "sluice/core/simd.h"

namespace sluice::evaluate {

namespace {

constexpr int kRuns = 5;

template <class Work>
double leastSeconds(const Work& work) {
  using Clock = std::chrono::steady_clock;
  double least = 1e9;
  for (int run = 0; run < kRuns; ++run) {
    const auto start = Clock::now();
    work();
    least = std::min(least, std::chrono::duration<double>(Clock::now() - start).count());
  }
  return least;
}

SLUICE_SIMD_CLONES void triad(float* __restrict a, const float* __restrict b, const float* __restrict c,
                              std::ptrdiff_t count) {
  for (std::ptrdiff_t i = 0; i < count; ++i) a[i] = b[i] + 3.0F * c[i];
}

double bandwidth() {
  constexpr std::ptrdiff_t kCount = 1 << 25;  // 128 MiB an array
  constexpr std::ptrdiff_t kPiece = 1 << 15;
  std::vector<float> a(kCount, 1);
  std::vector<float> b(kCount, 2);
  std::vector<float> c(kCount, 3);
  const double seconds = leastSeconds([&] {
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t at = 0; at < kCount; at += kPiece) triad(a.data() + at, b.data() + at, c.data() + at, kPiece);
  });
  return 3.0 * sizeof(float) * static_cast<double>(kCount) / seconds * 1e-9;
}

/// Sums enough that none waits for itself: of any vector's width, ten of them.
constexpr int kSums = 160;

/// Returns something that depends on all of it.
SLUICE_SIMD_CLONES float multiplyAndAdd(int rounds) {
  std::array<float, kSums> sums;
  for (int i = 0; i < kSums; ++i) sums[static_cast<std::size_t>(i)] = static_cast<float>(i);
  for (int round = 0; round < rounds; ++round) {
    for (float& sum : sums) sum = sum * 0.999F + 0.5F;
  }
  float total = 0;
  for (const float sum : sums) total += sum;
  return total;
}

double peak() {
  constexpr int kRounds = 200'000;
  const int threads = omp_get_max_threads();
  std::vector<float> results(static_cast<std::size_t>(threads));
  const double seconds = leastSeconds([&] {
#pragma omp parallel
    results[static_cast<std::size_t>(omp_get_thread_num())] += multiplyAndAdd(kRounds);
  });
  return 2.0 * kSums * kRounds * threads / seconds * 1e-9;
}

}  // namespace

MachineLimits measureMachineLimits() { return {bandwidth(), peak(), omp_get_max_threads()}; }

}  // namespace sluice::evaluate
