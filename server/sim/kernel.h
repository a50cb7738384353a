#pragma once

#include <cmath>
#include <numbers>

namespace sluice::sim {

/// Cubic spline, Monaghan 1992, with compact support H: W(r) = k f(q), q = r/H, k = 8/(π H³) in three dimensions.
///
/// A kernel is a type with these static members; adding one means adding a type like this, its KernelKind and its case
/// in `withKernel`. `value` and `slope` take a float, a double, or a vector of floats, and are exactly 0 for q ≥ 1.
struct CubicSpline {
  static constexpr double kNormalisation = 8 / std::numbers::pi;  ///< k H³.
  static constexpr double kSteepestSlope = 2;                     ///< max |f'(q)|, reached at q = 1/3.

  /// f(q) = 6(q³ - q²) + 1 for q ≤ ½, 2(1-q)³ beyond. Both branches are 2t³ - m³ with t = 1-q, m = max(1-2q, 0).
  template <class V>
  [[gnu::always_inline]] static V value(V q) {
    const V t = positivePart(1.0F - q);
    const V m = positivePart(1.0F - 2.0F * q);
    return 2.0F * t * t * t - m * m * m;
  }

  /// f'(q) = 6(m² - t²), which is 6q(3q-2) for q ≤ ½ and -6(1-q)² beyond.
  template <class V>
  [[gnu::always_inline]] static V slope(V q) {
    const V t = positivePart(1.0F - q);
    const V m = positivePart(1.0F - 2.0F * q);
    return 6.0F * (m * m - t * t);
  }

 private:
  template <class V>
  [[gnu::always_inline]] static V positivePart(V x) {
    const V zero{};
    return x > zero ? x : zero;
  }
};

enum class KernelKind { CubicSpline };

/// Calls `action` with a default-constructed kernel of the kind named, so that loops are compiled for each kernel.
template <class Action>
decltype(auto) withKernel(KernelKind kind, Action&& action) {
  switch (kind) {
    case KernelKind::CubicSpline:
      break;
  }
  return action(CubicSpline{});
}

/// W(r) of support radius H, 1/m³.
template <class Kernel>
double kernelValue(double r, double support) {
  return Kernel::kNormalisation / (support * support * support) * Kernel::value(r / support);
}

/// dW/dr of support radius H, 1/m⁴.
template <class Kernel>
double kernelSlope(double r, double support) {
  return Kernel::kNormalisation / (support * support * support * support) * Kernel::slope(r / support);
}

}  // namespace sluice::sim
