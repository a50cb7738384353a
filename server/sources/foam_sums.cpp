#include "foam_sums.h"

#include <cstring>

#if defined(__SSE2__)
#include <immintrin.h>
#else
#include <cmath>
#endif

// Compiles a function for several instruction sets and picks the best at run time. The lanes fix the order of every
// sum and nothing fuses multiply-adds, so that every version gives the same bits.
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define SLUICE_FOAM_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define SLUICE_FOAM_CLONES
#endif

namespace sluice::sources {

namespace {

/// Split by the compiler into what the instruction set has.
typedef float Lanes __attribute__((vector_size(kLanes * sizeof(float))));
typedef float HalfLanes __attribute__((vector_size(kLanes * sizeof(float) / 2)));

// Helpers of cloned functions must be inlined, or every clone would call the one version for all instruction sets.
#define SLUICE_INLINE [[gnu::always_inline]] inline

SLUICE_INLINE Lanes load(const std::vector<float>& from, std::size_t first) {
  Lanes value;
  std::memcpy(&value, &from[first], sizeof value);
  return value;
}

SLUICE_INLINE Lanes squareRoot(Lanes v) {
#if defined(__SSE2__)
  HalfLanes low = __builtin_shufflevector(v, v, 0, 1, 2, 3);
  HalfLanes high = __builtin_shufflevector(v, v, 4, 5, 6, 7);
  low = (HalfLanes)_mm_sqrt_ps((__m128)low);
  high = (HalfLanes)_mm_sqrt_ps((__m128)high);
  return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
#else
  Lanes root;
  for (std::size_t lane = 0; lane < kLanes; ++lane) root[lane] = std::sqrt(v[lane]);
  return root;
#endif
}

SLUICE_INLINE Lanes positive(Lanes v) { return v > 0 ? v : Lanes{}; }

SLUICE_INLINE float total(Lanes v) { return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7])); }

/// From a point to eight particles, or eight velocities from one.
struct Differences {
  Lanes x, y, z;

  SLUICE_INLINE Lanes dot(const Differences& other) const { return x * other.x + y * other.y + z * other.z; }
};

SLUICE_INLINE Differences positionsLess(const NearbyLiquid& nearby, std::size_t first, const Eigen::Vector3f& point) {
  return {load(nearby.x, first) - point[0], load(nearby.y, first) - point[1], load(nearby.z, first) - point[2]};
}

}  // namespace

SLUICE_FOAM_CLONES
SurroundingSums sumSurroundings(const NearbyLiquid& nearby, const Eigen::Vector3f& point, float support) {
  const float inverse = 1 / support;
  const Lanes one = Lanes{} + 1.0F;
  Lanes count{}, weight{}, vx{}, vy{}, vz{};
  for (std::size_t first = 0; first < nearby.padded(); first += kLanes) {
    const Differences x = positionsLess(nearby, first, point);
    const Lanes near = positive(1 - squareRoot(x.dot(x)) * inverse);
    count += near > 0 ? one : Lanes{};
    weight += near;
    vx += near * load(nearby.vx, first);
    vy += near * load(nearby.vy, first);
    vz += near * load(nearby.vz, first);
  }
  return {total(count), total(weight), {total(vx), total(vy), total(vz)}};
}

SLUICE_FOAM_CLONES
MotionSums sumMotion(const NearbyLiquid& nearby, const Eigen::Vector3f& point, const Eigen::Vector3f& velocity,
                     float support) {
  const float inverse = 1 / support;
  const Lanes one = Lanes{} + 1.0F;
  Lanes count{}, approach{}, nx{}, ny{}, nz{};
  for (std::size_t first = 0; first < nearby.padded(); first += kLanes) {
    // Both differences the other way round, which leaves their product as it is.
    const Differences x = positionsLess(nearby, first, point);
    const Differences v{load(nearby.vx, first) - velocity[0], load(nearby.vy, first) - velocity[1],
                        load(nearby.vz, first) - velocity[2]};
    const Lanes distance = squareRoot(x.dot(x));
    const Lanes near = positive(1 - distance * inverse);
    // 0/1 instead of 0/0 for what coincides.
    const Lanes along = v.dot(x) / (distance > 0 ? distance : one);
    count += near > 0 ? one : Lanes{};
    approach += near * (squareRoot(v.dot(v)) - along);
    nx -= near * x.x;
    ny -= near * x.y;
    nz -= near * x.z;
  }
  return {total(count), total(approach), {total(nx), total(ny), total(nz)}};
}

SLUICE_FOAM_CLONES
BendSums sumBend(const NearbyLiquid& nearby, const NearbyNormals& normals, const Eigen::Vector3f& point,
                 const Eigen::Vector3f& normal, float support) {
  const float inverse = 1 / support;
  const Differences own{Lanes{} + normal[0], Lanes{} + normal[1], Lanes{} + normal[2]};
  Lanes weight{}, bend{};
  for (std::size_t first = 0; first < nearby.padded(); first += kLanes) {
    const Differences x = positionsLess(nearby, first, point);
    const Differences n{load(normals.x, first), load(normals.y, first), load(normals.z, first)};
    const Lanes near = positive(1 - squareRoot(x.dot(x)) * inverse);
    const Lanes ofSurface = n.dot(n) > 0.5F ? near : Lanes{};
    weight += ofSurface;
    bend += x.dot(own) < 0 ? ofSurface * (1 - n.dot(own)) : Lanes{};
  }
  return {total(weight), total(bend)};
}

}  // namespace sluice::sources
