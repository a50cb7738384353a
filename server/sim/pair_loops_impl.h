// The loops over pairs, for the instruction set that the including unit is compiled for. Such a unit defines
// SLUICE_PAIR_LOOPS, the name of its table, and SLUICE_INSTRUCTION_SET, the name people see.

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

void weighSquares(const PairList& list, const Mobility& mobility, float* result) {
  const PairGroup* group = list.groups;
  for (std::uint32_t i = list.first; i < list.last; ++i) {
    Lanes sum{};
    for (const PairGroup* end = group + list.groupCount[i]; group != end; ++group) {
      const Lanes gradient = gradients(*group);
      sum += byFluid(mobility.fluid, mobility.ofFluid.data(), *group) * (gradient * gradient);
    }
    result[i] = sumLanes(sum) * (list.quantum * list.quantum);
  }
}

template <bool kUnequal>
SLUICE_INLINE void applyImpulsesTo(const PairList& list, const Mobility& mobility, const Float4* impulse,
                                   const Float4* gradientSum, const Float4* velocity, Float4* result) {
  const PairGroup* group = list.groups;
  for (std::uint32_t i = list.first; i < list.last; ++i) {
    const Lanes4 sum = sumOverPairs(group, list.groupCount[i], impulse) * list.quantum;
    Lanes4 change = load<Lanes4>(impulse + i) * load<Lanes4>(gradientSum + i) + sum;
    if constexpr (kUnequal) change *= mobility.ofFluid[mobility.fluid[i]];
    store(result + i, load<Lanes4>(velocity + i) - change);
  }
}

void applyImpulses(const PairList& list, const Mobility& mobility, const Float4* impulse, const Float4* gradientSum,
                   const Float4* velocity, Float4* result) {
  if (mobility.fluid == nullptr) {
    applyImpulsesTo<false>(list, mobility, impulse, gradientSum, velocity, result);
  } else {
    applyImpulsesTo<true>(list, mobility, impulse, gradientSum, velocity, result);
  }
}

SolveError relaxImpulses(const PairList& list, const Float4* velocity, const Float4* gradientSum, const float* factor,
                         const float* density, float seconds, Float4* impulse) {
  // Plain Jacobi (1) diverges on dense clusters, Bender & Koschier take 1/2.
  constexpr float kRelaxation = 0.5F;
  const float perSecond = 1 / seconds;
  const PairGroup* group = list.groups;
  SolveError error;
  for (std::uint32_t i = list.first; i < list.last; ++i) {
    const Lanes4 sum = sumOverPairs(group, list.groupCount[i], velocity) * list.quantum;
    const Lanes4 terms = load<Lanes4>(velocity + i) * load<Lanes4>(gradientSum + i) - sum;
    const float excess = sumLanes(terms) - (density != nullptr ? (1.0F - density[i]) * perSecond : 0.0F);
    const float relaxed = impulse[i].x + kRelaxation * factor[i] * excess;
    const float next = factor[i] > 0.0F && relaxed > 0.0F ? relaxed : 0.0F;
    impulse[i] = {next, next, next, next};
    const float compression = factor[i] > 0.0F && excess > 0.0F ? excess * seconds : 0.0F;
    error.sum += static_cast<double>(compression);
    error.largest = compression > error.largest ? compression : error.largest;
  }
  return error;
}

template <bool kSeveral>
SLUICE_INLINE void applyViscosityOf(const PairList& list, const PairScale& scale, const PairFriction& friction,
                                    const Float4* position, const Float4* velocity, Float4* result) {
  const Lanes softening = splat(0.01F * scale.support * scale.support);
  const PairGroup* group = list.groups;
  for (std::uint32_t i = list.first; i < list.last; ++i) {
    const Lanes4 xi = load<Lanes4>(position + i);
    const Lanes4 vi = load<Lanes4>(velocity + i);
    const Lanes x4 = join(xi, xi, xi, xi);
    const Lanes v4 = join(vi, vi, vi, vi);
    const float* strength = friction.strength[0].data();
    if constexpr (kSeveral) strength = friction.strength[friction.fluid[i]].data();
    Lanes sum{};
    for (const PairGroup* end = group + list.groupCount[i]; group != end; ++group) {
      const Lanes xij = x4 - ofNeighbours(position, *group);
      Lanes approach = sumWithinQuarters((v4 - ofNeighbours(velocity, *group)) * gradients(*group));
      if constexpr (kSeveral) approach *= byFluid(friction.fluid, strength, *group);
      sum += approach / (sumWithinQuarters(xij * xij) + softening) * xij;
    }
    store(result + i, vi + sumQuarters(sum) * (kSeveral ? list.quantum : *strength * list.quantum));
  }
}

void applyViscosity(const PairList& list, const PairScale& scale, const PairFriction& friction, const Float4* position,
                    const Float4* velocity, Float4* result) {
  if (friction.fluid == nullptr) {
    applyViscosityOf<false>(list, scale, friction, position, velocity, result);
  } else {
    applyViscosityOf<true>(list, scale, friction, position, velocity, result);
  }
}

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
    case KernelKind::CubicSpline:
      break;
  }
  return findNeighboursOf<CubicSpline>(scale, candidates, position, first, last, out, sums);
}

template <class Kernel>
SLUICE_INLINE void addBoundaryOf(const PairScale& scale, const Candidates& candidates, const Float4* position,
                                 std::uint32_t first, std::uint32_t last, const PairSums& sums) {
  const float inverseSupport = 1 / scale.support;
  const Lanes tiny = splat(1e-6F * scale.support);
  // `value` and `slope` are per fluid particle's volume; boundary particles bring their own, as a multiple of it.
  for (std::uint32_t i = first; i < last; ++i) {
    const Float4 xi = position[i];
    Lanes values{};
    Lanes gx{}, gy{}, gz{};
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
      gx += perMetre * dx;
      gy += perMetre * dy;
      gz += perMetre * dz;
      near += static_cast<std::uint32_t>(__builtin_popcount(bitsOf(q < 1.0F)));
    }
    sums.density[i] += scale.value * sumLanes(values);
    Float4& gradient = sums.gradientSum[i];
    gradient.x += scale.slope * sumLanes(gx);
    gradient.y += scale.slope * sumLanes(gy);
    gradient.z += scale.slope * sumLanes(gz);
    sums.neighbours[i] = static_cast<std::uint16_t>(sums.neighbours[i] + near);
  }
}

void addBoundary(const PairScale& scale, const Candidates& candidates, const Float4* position, std::uint32_t first,
                 std::uint32_t last, const PairSums& sums) {
  switch (scale.kernel) {
    case KernelKind::CubicSpline:
      break;
  }
  addBoundaryOf<CubicSpline>(scale, candidates, position, first, last, sums);
}

}  // namespace

extern const PairLoops SLUICE_PAIR_LOOPS;
const PairLoops SLUICE_PAIR_LOOPS{SLUICE_INSTRUCTION_SET, findNeighbours, addBoundary,   weighSquares,
                                  applyImpulses,          relaxImpulses,  applyViscosity};

}  // namespace sluice::sim
