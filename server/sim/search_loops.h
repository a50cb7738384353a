#pragma once

// The search for neighbours, and the sums that it makes on the way. Included by pair_loops_impl.h alone, once for each
// instruction set.

#include "pair_lanes.h"

namespace sluice::sim {
namespace {

/// Interleaves three integer components into the groups' layout: four 16-bit fields a pair.
SLUICE_INLINE void storeGradients(PairGroup* out, Ints x, Ints y, Ints z) {
  const Words xy = ((Words)x & 0xFFFFU) | ((Words)y << 16);
  const Words z0 = (Words)z & 0xFFFFU;
  store(&out[0].gradient, __builtin_shufflevector(xy, z0, 0, 16, 1, 17, 2, 18, 3, 19));
  store(&out[1].gradient, __builtin_shufflevector(xy, z0, 4, 20, 5, 21, 6, 22, 7, 23));
  store(&out[2].gradient, __builtin_shufflevector(xy, z0, 8, 24, 9, 25, 10, 26, 11, 27));
  store(&out[3].gradient, __builtin_shufflevector(xy, z0, 12, 28, 13, 29, 14, 30, 15, 31));
}

/// Slots of the candidates closer than the support, in rising order, padded to kLanes with the slot of a far point.
SLUICE_INLINE std::size_t findSlots(const Candidates& candidates, const Float4& xi, std::uint32_t i,
                                    float supportSquared) {
  constexpr std::size_t kLanes = Candidates::kLanes;
  std::size_t found = 0;
  for (std::size_t c = 0; c < candidates.count; c += kLanes) {
    const Lanes dx = xi.x - load<Lanes>(&candidates.x[c]);
    const Lanes dy = xi.y - load<Lanes>(&candidates.y[c]);
    const Lanes dz = xi.z - load<Lanes>(&candidates.z[c]);
    const Lanes distanceSquared = dx * dx + dy * dy + dz * dz;
    const Ints near = distanceSquared < supportSquared;
    const Ints other = load<Ints>(&candidates.index[c]) != static_cast<std::int32_t>(i);
    found += writeSetBits(bitsOf(near & other), static_cast<std::uint32_t>(c), &candidates.slots[found]);
  }
  const auto far = static_cast<std::uint32_t>(candidates.count);
  for (std::size_t lane = 0; lane < kLanes; ++lane) candidates.slots[found + lane] = far;
  return found;
}

template <class Kernel>
SLUICE_INLINE PairGroup* findNeighboursOf(const PairScale& scale, const Candidates& candidates, const Float4* position,
                                          std::uint32_t first, std::uint32_t last, PairGroup* out,
                                          const PairSums& sums) {
  constexpr std::size_t kLanes = Candidates::kLanes;
  const float inverseSupport = 1 / scale.support;
  const float supportSquared = scale.support * scale.support;
  // Below this distance two particles have no direction between them; the gradient is taken as 0.
  const Lanes tiny = splat(1e-6F * scale.support);
  const Lanes toQuanta = splat(scale.slope * scale.inverseQuantum);

  for (std::uint32_t i = first; i < last; ++i) {
    const Float4 xi = position[i];
    const std::size_t found = findSlots(candidates, xi, i, supportSquared);
    Lanes values{};
    Lanes gx{}, gy{}, gz{}, squares{};
    const std::size_t groups = (found + 3) / 4;
    for (std::size_t n = 0; n < found; n += kLanes) {
      const Ints slots = load<Ints>(&candidates.slots[n]);
      const Lanes dx = xi.x - gather(candidates.x, slots);
      const Lanes dy = xi.y - gather(candidates.y, slots);
      const Lanes dz = xi.z - gather(candidates.z, slots);
      const Lanes distance = squareRoot(dx * dx + dy * dy + dz * dz);
      const Lanes q = distance * inverseSupport;
      values += Kernel::value(q);
      // The far point of the padding has q ≫ 1, where value and slope are 0.
      const Lanes perMetre = distance > tiny ? toQuanta * Kernel::slope(q) / distance : Lanes{};
      const Ints ix = roundToInt(perMetre * dx);
      const Ints iy = roundToInt(perMetre * dy);
      const Ints iz = roundToInt(perMetre * dz);
      storeGradients(out + n / 4, ix, iy, iz);
      const Ints index = gather(candidates.index, slots);
      const Ints neighbour = index < 0 ? static_cast<std::int32_t>(i) - Ints{} : index;
      for (std::size_t g = 0; g < 4; ++g) {
        std::memcpy(&out[n / 4 + g].neighbour, reinterpret_cast<const char*>(&neighbour) + 16 * g, 16);
      }
      const Lanes fx = __builtin_convertvector(ix, Lanes);
      const Lanes fy = __builtin_convertvector(iy, Lanes);
      const Lanes fz = __builtin_convertvector(iz, Lanes);
      gx += fx;
      gy += fy;
      gz += fz;
      squares += fx * fx + fy * fy + fz * fz;
    }
    out += groups;
    sums.groups[i] = static_cast<std::uint16_t>(groups);
    sums.neighbours[i] = static_cast<std::uint16_t>(found);
    sums.density[i] = scale.value * (1.0F + sumLanes(values));  // f(0) = 1: the particle itself.
    sums.gradientSum[i] = {sumLanes(gx) * scale.quantum, sumLanes(gy) * scale.quantum, sumLanes(gz) * scale.quantum, 0};
    sums.gradientSquares[i] = sumLanes(squares) * (scale.quantum * scale.quantum);
  }
  return out;
}

PairGroup* findNeighbours(const PairScale& scale, const Candidates& candidates, const Float4* position,
                          std::uint32_t first, std::uint32_t last, PairGroup* out, const PairSums& sums) {
  switch (scale.kernel) {
    case KernelKind::WendlandC2:
      return findNeighboursOf<WendlandC2>(scale, candidates, position, first, last, out, sums);
    case KernelKind::CubicSpline:
      break;
  }
  return findNeighboursOf<CubicSpline>(scale, candidates, position, first, last, out, sums);
}

template <class Kernel, bool kMirrored>
SLUICE_INLINE void addBoundaryOf(const PairScale& scale, const Candidates& candidates, const Float4* position,
                                 std::uint32_t first, std::uint32_t last, const PairSums& sums, WallSums* walls) {
  const float inverseSupport = 1 / scale.support;
  const Lanes tiny = splat(1e-6F * scale.support);
  // `value` and `slope` are per fluid particle's volume; boundary particles bring their own, as a multiple of it.
  for (std::uint32_t i = first; i < last; ++i) {
    const Float4 xi = position[i];
    Lanes values{};
    Lanes gx{}, gy{}, gz{};
    Lanes xx{}, yy{}, zz{}, xy{}, xz{}, yz{};
    std::uint32_t near = 0;
    for (std::size_t c = 0; c < candidates.count; c += Candidates::kLanes) {
      const Lanes dx = xi.x - load<Lanes>(&candidates.x[c]);
      const Lanes dy = xi.y - load<Lanes>(&candidates.y[c]);
      const Lanes dz = xi.z - load<Lanes>(&candidates.z[c]);
      const Lanes volume = load<Lanes>(&candidates.volume[c]);
      const Lanes distance = squareRoot(dx * dx + dy * dy + dz * dz);
      const Lanes q = distance * inverseSupport;
      values += volume * Kernel::value(q);
      const Lanes perMetre = distance > tiny ? volume * Kernel::slope(q) / distance : Lanes{};
      const Lanes px = perMetre * dx;
      const Lanes py = perMetre * dy;
      const Lanes pz = perMetre * dz;
      gx += px;
      gy += py;
      gz += pz;
      if constexpr (kMirrored) {
        xx += px * dx;
        yy += py * dy;
        zz += pz * dz;
        xy += px * dy;
        xz += px * dz;
        yz += py * dz;
      }
      near += static_cast<std::uint32_t>(__builtin_popcount(bitsOf(q < 1.0F)));
    }
    sums.density[i] += scale.value * sumLanes(values);
    sums.neighbours[i] = static_cast<std::uint16_t>(sums.neighbours[i] + near);
    const float slope = scale.slope;
    const Float4 once = {slope * sumLanes(gx), slope * sumLanes(gy), slope * sumLanes(gz), 0};
    if constexpr (kMirrored) {
      walls[i - first] = {once,
                          -slope * sumLanes(xx),
                          -slope * sumLanes(yy),
                          -slope * sumLanes(zz),
                          -slope * sumLanes(xy),
                          -slope * sumLanes(xz),
                          -slope * sumLanes(yz)};
    } else {
      Float4& gradient = sums.gradientSum[i];
      gradient = {gradient.x + once.x, gradient.y + once.y, gradient.z + once.z, 0};
    }
  }
}

template <bool kMirrored>
SLUICE_INLINE void addBoundaryBy(const PairScale& scale, const Candidates& candidates, const Float4* position,
                                 std::uint32_t first, std::uint32_t last, const PairSums& sums, WallSums* walls) {
  switch (scale.kernel) {
    case KernelKind::WendlandC2:
      return addBoundaryOf<WendlandC2, kMirrored>(scale, candidates, position, first, last, sums, walls);
    case KernelKind::CubicSpline:
      break;
  }
  addBoundaryOf<CubicSpline, kMirrored>(scale, candidates, position, first, last, sums, walls);
}

void addBoundary(const PairScale& scale, const Candidates& candidates, const Float4* position, std::uint32_t first,
                 std::uint32_t last, const PairSums& sums) {
  addBoundaryBy<false>(scale, candidates, position, first, last, sums, nullptr);
}

void weighBoundary(const PairScale& scale, const Candidates& candidates, const Float4* position, std::uint32_t first,
                   std::uint32_t last, const PairSums& sums, WallSums* walls) {
  addBoundaryBy<true>(scale, candidates, position, first, last, sums, walls);
}

}  // namespace
}  // namespace sluice::sim
