#include "sluice/core/ray.h"

#include <cmath>
#include <numbers>

namespace sluice::core {

Ray rayThrough(const Camera& camera, ImageSize size, double x, double y) {
  const ViewBasis basis = viewBasis(camera);
  const double halfHeight = std::tan(0.5 * camera.verticalFovDegrees * std::numbers::pi / 180);
  const double halfWidth = halfHeight * size.width / size.height;
  const auto right = static_cast<float>((2 * x - 1) * halfWidth);
  const auto up = static_cast<float>((1 - 2 * y) * halfHeight);
  return {camera.eye, (basis.forward + right * basis.right + up * basis.up).normalized(), basis.forward};
}

}  // namespace sluice::core
