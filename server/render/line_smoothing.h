#pragma once

#include <span>

namespace sluice::render {

/// What lines of cells exchange with each other.
struct LineSmoothing {
  int sweeps = 0;     ///< Along either axis; each adds 2/3 cell² to the variance.
  float limit = 0;    ///< Cells farther apart than this exchange nothing.
  float outside = 0;  ///< What stands beyond the grid. Rows of nothing else are left as they are.
};

/// Sweeps that make a Gaussian of standard deviation `cells`, at most as many as stay cheap.
int sweepsFor(float cells);

/// Smooths a grid of `width` cells a row in place. Uses the OpenMP team of the calling thread; the result is the same
/// for any number of threads.
void smoothLines(std::span<float> cells, int width, const LineSmoothing& settings);

}  // namespace sluice::render
