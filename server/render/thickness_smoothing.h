#pragma once

#include <span>
#include <vector>

#include "view_geometry.h"

namespace sluice::render {

/// Lets thickness even out along rows and columns, on the CPU: what smooth_thickness.frag does on the device.
///
/// Each pixel exchanges w_i·(t_j − t) with the pixels i steps away, w_i = (1 − i²/ρ²)²: close to a Gaussian, without an
/// exponential, of variance ρ²/7. ρ follows the depth of the surface, so that distant liquid is no smoother than near.
/// Only pixels with liquid take part: rims neither thin out nor spread, and the sum over the picture stays, the
/// liquid's volume. Uses the OpenMP team of the calling thread; the result is the same for any number of threads.
class ThicknessSmoothing {
 public:
  /// Farthest exchange, pixels of the thickness; bounds the cost of liquid right before the eye.
  static constexpr int kLargestReach = 16;

  /// √7: from the standard deviation of (1 − x²/ρ²)² to ρ.
  static constexpr float kReachOfDeviation = 2.6457513F;

  /// `deviation` is the Gaussian's σ, m; `surface` holds inverse depths as `surfaceView` sees them.
  void smooth(std::span<float> thickness, const ViewGeometry& thicknessView, std::span<const float> surface,
              const ViewGeometry& surfaceView, float deviation);

 private:
  void findReach(const ViewGeometry& thicknessView, std::span<const float> surface, const ViewGeometry& surfaceView,
                 float deviation);

  std::vector<float> inverseSquare_;  ///< 1/ρ² of every pixel.
  std::vector<int> rowReach_;
  std::vector<float> padded_;
};

}  // namespace sluice::render
