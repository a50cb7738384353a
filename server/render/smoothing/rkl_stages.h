#pragma once

#include <vector>

namespace sluice::render {

/// One stage of the second-order Runge–Kutta–Legendre step RKL2 for y_t = f(y), Meyer, Balsara & Aslam 2014 [MBA14],
/// with surfaces counted from the one that the step began with:
///   Y_j = Y_0 + last·(Y_{j−1} − Y_0) + before·(Y_{j−2} − Y_0) + Δt·(rate·f(Y_{j−1}) + startRate·f(Y_0)).
struct RklStage {
  double last = 0;
  double before = 0;
  double rate = 0;
  double startRate = 0;
};

/// More would make one frame take seconds; a step of so many is 2,500 explicit ones long.
constexpr int kMostRklStages = 99;

/// The stages j = 1 … `stages` of a step; an odd number, 3 at least, whose damping of short waves is the better.
std::vector<RklStage> rklStages(int stages);

/// How many forward Euler steps of the largest stable size a step of so many stages is long: (s² + s − 2)/4.
double rklLength(int stages);

}  // namespace sluice::render
