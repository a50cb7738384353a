#pragma once

#include <vector>

#include "padded_field.h"

namespace sluice::render {

/// Solves (I − L) x = b on a picture by multigrid V(1,1)-cycles, where
///   L x = c11·x_xx + 2·c12·x_xy + c22·x_yy
/// in second differences over one pixel. Coefficients are 0 where the pixel's neighbours along an axis do not belong to
/// its surface, which cuts the surface there; transfers between the grids stay those of an uncut picture, as cutting
/// them too makes the cycle diverge at silhouettes.
///
/// Smoothing is damped Jacobi within a row and Gauss–Seidel between even and odd rows: it runs over whole vectors, with
/// the same result whatever their width.
class Multigrid {
 public:
  struct Level {
    Level(int levelWidth, int levelHeight);

    int width;
    int height;
    std::vector<RowSpan> spans;  ///< Outside, everything is and stays 0.
    PaddedField c11, c12, c22;
    PaddedField inverseDiagonal;
    PaddedField b, x, residual;
  };

  /// Grids for pictures of that size.
  Multigrid(int width, int height);

  /// To be filled in by the caller: spans, c11, c12, c22, b. `x` is the result.
  Level& finest() { return levels_.front(); }

  /// Derives the coarser grids from the finest's spans and coefficients. Call it before `solve`.
  void prepare();

  /// Starts from x = 0.
  void solve(int cycles);

 private:
  void cycle(std::size_t level, bool fromZero);

  std::vector<Level> levels_;
};

}  // namespace sluice::render
