#pragma once

#include <algorithm>

#include "sluice/solids/body_shape.h"

namespace sluice::solids {

/// Takes the part out of a vector that leads against a unit normal. Returns whether there was any.
inline bool takeOutInward(Eigen::Vector3d& vector, const Eigen::Vector3d& normal) {
  const double inward = vector.dot(normal);
  if (inward >= 0) return false;
  vector -= inward * normal;
  return true;
}

/// Moves a point from `x` to `to`, or as far as it gets without coming nearer to a surface than `clearance`: it slides
/// along what is in its way. It goes in pieces, none of which is longer than the way to the closest surface, so that it
/// cannot cross one, however thin. `closest(x, reach)` gives the closest point of all surfaces, `touch(normal)` is
/// called with the normal, towards the point, of each one that it slides along, and `hold(x)` may put the point back
/// into a convex region, which shortens a piece but never makes it longer. Returns whether anything was in the way.
template <class Closest, class Touch, class Hold>
bool slide(Eigen::Vector3d& x, const Eigen::Vector3d& to, double clearance, const Closest& closest, const Touch& touch,
           const Hold& hold) {
  // Enough for a move of 1.5 spacings in pieces of at least a quarter of one, with some to spare for corners. What is
  // left of it after them is not gone.
  constexpr int kMostPieces = 12;
  // Of the clearance: what counts as touching.
  constexpr double kTouching = 1.01;
  // Of the way to the closest surface: how far a piece may go where it does not stop at the clearance.
  constexpr double kSafeShare = 0.5;

  Eigen::Vector3d rest = to - x;
  bool held = false;
  for (int piece = 0; piece < kMostPieces && rest.squaredNorm() > 0; ++piece) {
    const ClosestPoint near = closest(x, rest.norm() + kTouching * clearance);
    if (near.distance < kTouching * clearance) {
      if (near.distance == 0) return true;
      const Eigen::Vector3d normal = (x - near.point) / near.distance;
      held = takeOutInward(rest, normal) || held;
      touch(normal, near.point);
    }
    const double length = rest.norm();
    const double allowed = std::max(near.distance - clearance, kSafeShare * near.distance);
    if (length <= allowed) {
      x += rest;
      rest.setZero();
    } else {
      x += rest * (allowed / length);
      rest *= 1 - allowed / length;
    }
    held = hold(x) || held;
  }
  const ClosestPoint near = closest(x, clearance);
  if (near.distance < clearance && near.distance > 0) {
    const Eigen::Vector3d normal = (x - near.point) / near.distance;
    touch(normal, near.point);
    x += std::min(clearance - near.distance, kSafeShare * near.distance) * normal;
    hold(x);
    held = true;
  }
  return held;
}

}  // namespace sluice::solids
