#pragma once

#include <cmath>
#include <numbers>

namespace sluice::sim {

template <class V>
[[gnu::always_inline]] inline V positivePart(V x) {
  const V zero{};
  return x > zero ? x : zero;
}

/// Cubic spline, Monaghan 1992, with compact support H: W(r) = k f(q), q = r/H.
///
/// A kernel is a type with these static members; adding one means adding a type like this, its KernelKind and its case
/// in `withKernel`. `value` and `slope` take a float, a double, or a vector of floats, and are exactly 0 for q ≥ 1;
/// f(0) = 1.
struct CubicSpline {
  static constexpr double kSteepestSlope = 2;  ///< max |f'(q)|, reached at q = 1/3.

  /// k H^D in D = 2 or 3 dimensions.
  static constexpr double normalisation(int dimensions) {
    return dimensions == 2 ? 40 / (7 * std::numbers::pi) : 8 / std::numbers::pi;
  }

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
};

/// Wendland's function of smoothness C², Wendland 1995; its Fourier transform is positive, which keeps particles from
/// pairing however many neighbours there are [Dehnen & Aly 2012].
struct WendlandC2 {
  static constexpr double kSteepestSlope = 135.0 / 64;  ///< Reached at q = 1/4.

  static constexpr double normalisation(int dimensions) {
    return dimensions == 2 ? 7 / std::numbers::pi : 21 / (2 * std::numbers::pi);
  }

  /// f(q) = (1-q)⁴ (4q+1).
  template <class V>
  [[gnu::always_inline]] static V value(V q) {
    const V t = positivePart(1.0F - q);
    return t * t * t * t * (4.0F * q + 1.0F);
  }

  /// f'(q) = -20 q (1-q)³.
  template <class V>
  [[gnu::always_inline]] static V slope(V q) {
    const V t = positivePart(1.0F - q);
    return -20.0F * q * t * t * t;
  }
};

enum class KernelKind { CubicSpline, WendlandC2 };

/// Calls `action` with a default-constructed kernel of the kind named, so that loops are compiled for each kernel.
template <class Action>
decltype(auto) withKernel(KernelKind kind, Action&& action) {
  switch (kind) {
    case KernelKind::WendlandC2:
      return action(WendlandC2{});
    case KernelKind::CubicSpline:
      break;
  }
  return action(CubicSpline{});
}

/// H^D.
inline double supportPower(double support, int dimensions) {
  return dimensions == 2 ? support * support : support * support * support;
}

/// W(r) of support radius H, 1/m³ (1/m² in two dimensions).
template <class Kernel>
double kernelValue(double r, double support, int dimensions = 3) {
  return Kernel::normalisation(dimensions) / supportPower(support, dimensions) * Kernel::value(r / support);
}

/// dW/dr of support radius H, 1/m⁴ (1/m³ in two dimensions).
template <class Kernel>
double kernelSlope(double r, double support, int dimensions = 3) {
  return Kernel::normalisation(dimensions) / (supportPower(support, dimensions) * support) * Kernel::slope(r / support);
}

}  // namespace sluice::sim
