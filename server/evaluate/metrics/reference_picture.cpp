#include "metrics/reference_picture.h"

#include <cmath>

namespace sluice::evaluate {

Mask ReferencePicture::interior(int margin, double edge) const {
  // What is steeper is seen along itself, where a pixel's depth says little about the surface.
  constexpr float kLeastCosine = 0.3F;
  Mask mask(sight.size);
  const auto [width, height] = sight.size;
  const auto stepsTo = [&](std::size_t i, int x, int y) {
    if (x < 0 || y < 0 || x >= width || y >= height) return false;
    const std::size_t j = sight.index(x, y);
    return liquid.set[j] != 0 && std::abs(depths[i] - depths[j]) > edge;
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const std::size_t i = sight.index(x, y);
      if (liquid.set[i] == 0 || !(cosines[i] > kLeastCosine)) continue;
      const bool step = stepsTo(i, x - 1, y) || stepsTo(i, x + 1, y) || stepsTo(i, x, y - 1) || stepsTo(i, x, y + 1);
      mask.set[i] = step ? 0 : 1;
    }
  }
  return eroded(mask, margin);
}

ReferencePicture traceReference(const Surface& surface, const Sight& sight) {
  ReferencePicture picture;
  picture.sight = sight;
  picture.liquid = Mask(sight.size);
  picture.depths.assign(sight.pixels(), 0);
  picture.normals.assign(sight.pixels(), Eigen::Vector3f::Zero());
  picture.cosines.assign(sight.pixels(), 0);
  picture.curvatures.assign(sight.pixels(), 0);
  // Rows cost very different amounts; each thread takes the next.
#pragma omp parallel for schedule(dynamic)
  for (int y = 0; y < sight.size.height; ++y) {
    for (int x = 0; x < sight.size.width; ++x) {
      const Eigen::Vector3d line = sight.line(x, y);
      const double length = line.norm();
      const Eigen::Vector3d direction = sight.toWorld * line / length;
      const std::optional<Hit> hit = surface.trace(sight.eye, direction);
      if (!hit) continue;
      const std::size_t i = sight.index(x, y);
      picture.liquid.set[i] = 1;
      picture.depths[i] = hit->distance / length;
      picture.normals[i] = (sight.toWorld.transpose() * hit->normal).cast<float>();
      picture.cosines[i] = static_cast<float>(-hit->normal.dot(direction));
      picture.curvatures[i] = static_cast<float>(hit->curvature);
    }
  }
  return picture;
}

}  // namespace sluice::evaluate
