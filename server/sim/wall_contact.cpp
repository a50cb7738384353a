#include "wall_contact.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace sluice::sim {

namespace {

using Eigen::Matrix3f;
using Eigen::Vector3f;

/// Compression up to which a wall mirrors, and from which it does no longer.
constexpr float kMirroring = 0.005F;
constexpr float kMirroringNoMore = 0.02F;

/// So little of the liquid is left on the particle's side that the rest cannot stand for all.
constexpr float kLargestShare = 0.75F;

/// What is missing over what is there, of 1.
float missing(float share) {
  const float absent = std::clamp(share, 0.0F, kLargestShare);
  return absent / (1 - absent);
}

}  // namespace

float wallMirror(float density) {
  const float compression = density - 1;
  return 1 + std::clamp((kMirroringNoMore - compression) / (kMirroringNoMore - kMirroring), 0.0F, 1.0F);
}

WallContact wallContact(std::uint32_t particle, const WallSums& sums, float mirror) {
  WallContact contact;
  contact.particle = particle;

  const Vector3f gradient(sums.gradient.x, sums.gradient.y, sums.gradient.z);
  const float length = gradient.norm();
  if (!(length > 0)) return contact;
  Matrix3f share;
  share << sums.xx, sums.xy, sums.xz,  //
      sums.xy, sums.yy, sums.yz,       //
      sums.xz, sums.yz, sums.zz;
  // The eigenvalues and vectors of P N P in the plane of the wall.
  const Vector3f first = gradient.unitOrthogonal();
  const Vector3f second = gradient.cross(first) / length;
  const float a = first.dot(share * first);
  const float b = first.dot(share * second);
  const float c = second.dot(share * second);
  const float angle = 0.5F * std::atan2(2 * b, a - c);
  const float middle = 0.5F * (a + c);
  const float radius = std::hypot(0.5F * (a - c), b);
  const Vector3f along = std::cos(angle) * first + std::sin(angle) * second;
  const Vector3f across = std::cos(angle) * second - std::sin(angle) * first;
  const Matrix3f surplus = (mirror - 1) * (missing(middle + radius) * along * along.transpose() +
                                           missing(middle - radius) * across * across.transpose());
  contact.xx = surplus(0, 0);
  contact.yy = surplus(1, 1);
  contact.zz = surplus(2, 2);
  contact.xy = surplus(0, 1);
  contact.xz = surplus(0, 2);
  contact.yz = surplus(1, 2);
  return contact;
}

}  // namespace sluice::sim
