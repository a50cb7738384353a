#pragma once

#include <cmath>
#include <optional>

namespace sluice::evaluate {

/// The first place between `near` and `far` where a function of the distance along a line falls to 0. It falls by at
/// most 1 per metre, so a step as long as its value cannot pass a zero (sphere tracing, Hart 1996). A line that grazes
/// closer than a nanometre counts as meeting.
template <class Function>
std::optional<double> marchToZero(const Function& height, double near, double far) {
  constexpr double kMet = 1e-9;       // m; the shapes are metres in size
  constexpr int kMaxSteps = 100'000;  // a line that grazes for long takes thousands
  double t = near;
  for (int i = 0; i < kMaxSteps && t < far; ++i) {
    const double h = height(t);
    if (h < kMet) return t;
    t += h;
  }
  return std::nullopt;
}

}  // namespace sluice::evaluate
