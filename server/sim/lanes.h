#pragma once

// Vectors of the width that the data layout fixes, whatever the instruction set: the compiler splits them into what the
// unit is compiled for. Included only by the units that pair_loops_impl.h makes, which are compiled for different
// instruction sets; everything here is therefore local to the unit (nothing may be merged between units by the linker).

#include <cstdint>
#include <cstring>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include "particles.h"

namespace sluice::sim {
namespace {

// Passing wide vectors to functions has no stable ABI, and an inline function kept apart (in a debug build) could be
// shared with a unit compiled for another instruction set.
#define SLUICE_INLINE __attribute__((always_inline)) inline

typedef float Lanes4 __attribute__((vector_size(16)));
typedef float Lanes8 __attribute__((vector_size(32)));
typedef float Lanes __attribute__((vector_size(64)));
typedef std::int32_t Ints __attribute__((vector_size(64)));
typedef std::uint32_t Words __attribute__((vector_size(64)));
typedef std::uint32_t Words8 __attribute__((vector_size(32)));
typedef std::int16_t Shorts __attribute__((vector_size(32)));

template <class V, class T>
SLUICE_INLINE V load(const T* from) {
  V value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

template <class V, class T>
SLUICE_INLINE void store(T* to, V value) {
  std::memcpy(static_cast<void*>(to), &value, sizeof value);
}

SLUICE_INLINE Lanes splat(float value) { return value - Lanes{}; }

SLUICE_INLINE Lanes join(Lanes4 a, Lanes4 b, Lanes4 c, Lanes4 d) {
  const Lanes8 ab = __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7);
  const Lanes8 cd = __builtin_shufflevector(c, d, 0, 1, 2, 3, 4, 5, 6, 7);
  return __builtin_shufflevector(ab, cd, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
}

/// The sum of the four quarters, in one fixed order.
SLUICE_INLINE Lanes4 sumQuarters(Lanes v) {
  const Lanes8 low = __builtin_shufflevector(v, v, 0, 1, 2, 3, 4, 5, 6, 7);
  const Lanes8 high = __builtin_shufflevector(v, v, 8, 9, 10, 11, 12, 13, 14, 15);
  const Lanes8 pair = low + high;
  return __builtin_shufflevector(pair, pair, 0, 1, 2, 3) + __builtin_shufflevector(pair, pair, 4, 5, 6, 7);
}

SLUICE_INLINE float sumLanes(Lanes4 v) { return (v[0] + v[2]) + (v[1] + v[3]); }
SLUICE_INLINE float sumLanes(Lanes v) { return sumLanes(sumQuarters(v)); }

/// In every lane the sum over its quarter.
SLUICE_INLINE Lanes sumWithinQuarters(Lanes v) {
  const Lanes pairs = v + __builtin_shufflevector(v, v, 1, 0, 3, 2, 5, 4, 7, 6, 9, 8, 11, 10, 13, 12, 15, 14);
  return pairs + __builtin_shufflevector(pairs, pairs, 2, 3, 0, 1, 6, 7, 4, 5, 10, 11, 8, 9, 14, 15, 12, 13);
}

/// Correctly rounded, as IEEE 754 demands of every instruction set.
SLUICE_INLINE Lanes squareRoot(Lanes v) {
#if defined(__AVX512F__)
  return (Lanes)_mm512_sqrt_ps((__m512)v);
#else
  Lanes root;
  for (int quarter = 0; quarter < 4; ++quarter) {
    Lanes4 part;
    std::memcpy(&part, reinterpret_cast<const char*>(&v) + 16 * quarter, 16);
#if defined(__SSE2__)
    part = (Lanes4)_mm_sqrt_ps((__m128)part);
#else
    for (int lane = 0; lane < 4; ++lane) part[lane] = __builtin_sqrtf(part[lane]);
#endif
    std::memcpy(reinterpret_cast<char*>(&root) + 16 * quarter, &part, 16);
  }
  return root;
#endif
}

/// Bit l is set where lane l of `condition` is true (all ones).
SLUICE_INLINE std::uint32_t bitsOf(Ints condition) {
#if defined(__AVX512F__) && defined(__AVX512DQ__)
  return _mm512_movepi32_mask((__m512i)condition);
#elif defined(__SSE2__)
  std::uint32_t bits = 0;
  for (int quarter = 0; quarter < 4; ++quarter) {
    Lanes4 part;
    std::memcpy(&part, reinterpret_cast<const char*>(&condition) + 16 * quarter, 16);
    bits |= static_cast<std::uint32_t>(_mm_movemask_ps((__m128)part)) << (4 * quarter);
  }
  return bits;
#else
  std::uint32_t bits = 0;
  for (int lane = 0; lane < 16; ++lane) bits |= static_cast<std::uint32_t>(condition[lane] & 1) << lane;
  return bits;
#endif
}

/// Writes `base` + l for every set bit l, in rising order, and returns how many. May write up to 16 elements.
SLUICE_INLINE std::size_t writeSetBits(std::uint32_t bits, std::uint32_t base, std::uint32_t* out) {
#if defined(__AVX512F__)
  const __m512i lanes = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  const __m512i slots = _mm512_add_epi32(lanes, _mm512_set1_epi32(static_cast<int>(base)));
  _mm512_storeu_si512(out, _mm512_maskz_compress_epi32(static_cast<__mmask16>(bits), slots));
  return static_cast<std::size_t>(__builtin_popcount(bits));
#else
  std::size_t written = 0;
  for (; bits != 0; bits &= bits - 1) {
    out[written++] = base + static_cast<std::uint32_t>(__builtin_ctz(bits));
  }
  return written;
#endif
}

SLUICE_INLINE Lanes gather(const float* from, Ints slots) {
#if defined(__AVX512F__)
  return (Lanes)_mm512_i32gather_ps((__m512i)slots, from, 4);
#else
  Lanes value;
  for (int lane = 0; lane < 16; ++lane) value[lane] = from[slots[lane]];
  return value;
#endif
}

SLUICE_INLINE Ints gather(const std::uint32_t* from, Ints slots) {
#if defined(__AVX512F__)
  return (Ints)_mm512_i32gather_epi32((__m512i)slots, from, 4);
#else
  Ints value;
  for (int lane = 0; lane < 16; ++lane) value[lane] = static_cast<std::int32_t>(from[slots[lane]]);
  return value;
#endif
}

/// Nearest integer, halves away from zero: symmetric in sign.
SLUICE_INLINE Ints roundToInt(Lanes v) {
  const Lanes half = v < 0.0F ? splat(-0.5F) : splat(0.5F);
  return __builtin_convertvector(v + half, Ints);
}

}  // namespace
}  // namespace sluice::sim
