#pragma once

// What the loops over pairs share. Local to the unit that includes it, as lanes.h is.

#include "lanes.h"
#include "pair_loops.h"

namespace sluice::sim {
namespace {

/// The gradients of four pairs as floats, in quanta.
SLUICE_INLINE Lanes gradients(const PairGroup& group) {
  return __builtin_convertvector(__builtin_convertvector(load<Shorts>(&group.gradient), Ints), Lanes);
}

SLUICE_INLINE Lanes ofNeighbours(const Float4* values, const PairGroup& group) {
  return join(load<Lanes4>(values + group.neighbour[0]), load<Lanes4>(values + group.neighbour[1]),
              load<Lanes4>(values + group.neighbour[2]), load<Lanes4>(values + group.neighbour[3]));
}

/// Σ_j y_j ⊙ V ∇W_ij over the next `count` groups, component by component, in quanta.
SLUICE_INLINE Lanes4 sumOverPairs(const PairGroup*& group, int count, const Float4* values) {
  Lanes sum{};
  for (const PairGroup* end = group + count; group != end; ++group)
    sum += ofNeighbours(values, *group) * gradients(*group);
  return sumQuarters(sum);
}

/// A value for each of a group's four pairs, in all lanes of the pair: `ofFluid` by the neighbour's fluid.
SLUICE_INLINE Lanes byFluid(const std::uint8_t* fluid, const float* ofFluid, const PairGroup& group) {
  const auto value = [&](int pair) { return Lanes4{} + ofFluid[fluid[group.neighbour[pair]]]; };
  return join(value(0), value(1), value(2), value(3));
}

/// Lane k of each pair, in all of the pair's lanes.
template <int k>
SLUICE_INLINE Lanes spreadLane(Lanes v) {
  return __builtin_shufflevector(v, v, k, k, k, k, 4 + k, 4 + k, 4 + k, 4 + k, 8 + k, 8 + k, 8 + k, 8 + k, 12 + k,
                                 12 + k, 12 + k, 12 + k);
}

/// The cross product of each pair's vectors; 0 in the fourth lane.
SLUICE_INLINE Lanes cross(Lanes a, Lanes b) {
  const auto rotate = [](Lanes v) {
    return __builtin_shufflevector(v, v, 1, 2, 0, 3, 5, 6, 4, 7, 9, 10, 8, 11, 13, 14, 12, 15);
  };
  return rotate(a * rotate(b) - rotate(a) * b);
}

/// Differences of positions, each to the nearest image of the other particle where the box is periodic.
SLUICE_INLINE Lanes toNearestImage(Lanes difference, const PairScale& scale) {
  if (!scale.periodic) return difference;
  const Lanes4 length = load<Lanes4>(&scale.period);
  const Lanes4 half = load<Lanes4>(&scale.halfPeriod);
  const Lanes period = join(length, length, length, length);
  const Lanes farthest = join(half, half, half, half);
  difference -= difference > farthest ? period : Lanes{};
  difference += difference < -farthest ? period : Lanes{};
  return difference;
}

/// v with 0 in the fourth lane of each pair.
SLUICE_INLINE Lanes withoutFourth(Lanes v) {
  const Ints kept{-1, -1, -1, 0, -1, -1, -1, 0, -1, -1, -1, 0, -1, -1, -1, 0};
  return (Lanes)((Ints)v & kept);
}

}  // namespace
}  // namespace sluice::sim
