#include "foam_walls.h"

#include <algorithm>

namespace sluice::sources {

using Eigen::Vector3f;

float FoamWalls::openShare(const Vector3f& point, float support, float spacing) const {
  if (!box_) return 1;
  const auto openBeside = [&](float distance) {
    // The cap beyond a plane at D: π(h - D)²(2h + D)/3, of 4πh³/3.
    const float d = std::clamp((distance - 0.5F * spacing) / support, 0.0F, 1.0F);
    return 1 - 0.25F * (1 - d) * (1 - d) * (2 + d);
  };
  float open = 1;
  for (int axis = 0; axis < 3; ++axis) {
    open *= openBeside(point[axis] - box_->min()[axis]) * openBeside(box_->max()[axis] - point[axis]);
  }
  return open;
}

Vector3f FoamWalls::withoutWalls(Vector3f outward, const Vector3f& point, float support) const {
  if (!box_) return outward;
  for (int axis = 0; axis < 3; ++axis) {
    if (point[axis] - box_->min()[axis] < support) outward[axis] = std::max(outward[axis], 0.0F);
    if (box_->max()[axis] - point[axis] < support) outward[axis] = std::min(outward[axis], 0.0F);
  }
  return outward;
}

}  // namespace sluice::sources
