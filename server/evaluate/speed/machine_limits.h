#pragma once

namespace sluice::evaluate {

/// What this machine can do at most, measured with all threads of the OpenMP team.
struct MachineLimits {
  double gigabytesPerSecond = 0;  ///< STREAM's triad [McCalpin 1995] over arrays far larger than any cache.
  double gigaflopsPerSecond = 0;  ///< Single precision: multiplications and additions, not fused, as our loops are.
  int threads = 1;
};

/// The best of several runs; takes about a second.
MachineLimits measureMachineLimits();

}  // namespace sluice::evaluate
