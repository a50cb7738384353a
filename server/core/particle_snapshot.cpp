#include "sluice/core/particle_snapshot.h"

namespace sluice::core {

Eigen::AlignedBox3f boundsOf(const std::vector<Eigen::Vector3f>& positions) {
  Eigen::AlignedBox3f bounds;
  for (const Eigen::Vector3f& position : positions) bounds.extend(position);
  return bounds;
}

}  // namespace sluice::core
