#include "splat_rows.h"

#include <algorithm>
#include <cmath>

#include "sluice/core/simd.h"

namespace sluice::render {

namespace {

// Helpers of cloned functions must be inlined, or every clone would call the one version for all instruction sets.

/// What the pixels of one row have in common for one sphere.
struct SphereRow {
  float cx, cy, cz;
  float squaredRadius;
  float rowDiscriminant;  ///< R²(1+W_y²) − e_y².
  float rowCross;         ///< c_x·W_y.
  float rowMiddle;        ///< c_y·W_y + c_z.
};

[[gnu::always_inline]] inline SphereRow sphereRow(const ViewSphere& sphere, float slopeY) {
  const float squaredRadius = sphere.radius * sphere.radius;
  const float ey = sphere.y - sphere.z * slopeY;
  return {sphere.x,
          sphere.y,
          sphere.z,
          squaredRadius,
          squaredRadius * (1.0F + slopeY * slopeY) - ey * ey,
          sphere.x * slopeY,
          sphere.y * slopeY + sphere.z};
}

[[gnu::always_inline]] inline float discriminant(const SphereRow& row, float slopeX) {
  const float ex = row.cx - row.cz * slopeX;
  const float cross = row.rowCross - row.cy * slopeX;
  return row.rowDiscriminant + row.squaredRadius * slopeX * slopeX - ex * ex - cross * cross;
}

/// The same for one ellipsoid: a, m and the components of Lᵀ(w × c) as polynomials of W_x.
struct EllipsoidRow {
  float a0, a1, a2;
  float m0, m1;
  float s0, s1, t0, t1, u0, u1;
};

[[gnu::always_inline]] inline EllipsoidRow ellipsoidRow(const EllipsoidRays& r, const ViewEllipsoid& e, float y) {
  // w × c = (W_y·c_z − c_y, c_x − c_z·W_x, c_y·W_x − c_x·W_y).
  const float n1 = y * e.z - e.y;
  return {r.qzz + y * (2.0F * r.qyz + r.qyy * y),
          2.0F * (r.qxz + r.qxy * y),
          r.qxx,
          r.my * y + r.mz,
          r.mx,
          r.l11 * n1 + (r.l21 - r.l31 * y) * e.x,
          r.l31 * e.y - r.l21 * e.z,
          (r.l22 - r.l32 * y) * e.x,
          r.l32 * e.y - r.l22 * e.z,
          -r.l33 * y * e.x,
          r.l33 * e.y};
}

[[gnu::always_inline]] inline float squaredLength(const EllipsoidRow& row, float x) {
  return row.a0 + x * (row.a1 + row.a2 * x);
}

[[gnu::always_inline]] inline float discriminant(const EllipsoidRow& row, float x, float a) {
  const float s = row.s0 + row.s1 * x;
  const float t = row.t0 + row.t1 * x;
  const float u = row.u0 + row.u1 * x;
  return a - s * s - t * t - u * u;
}

/// Large, and yet times any m finite.
constexpr float kNoBackRim = 1e30F;

}  // namespace

float rimOf(const ViewSphere& sphere, float rimDepth) {
  // The plane c·(x − c) = −t·R·|c|.
  const float squared = sphere.x * sphere.x + sphere.y * sphere.y + sphere.z * sphere.z;
  return rimDepth > 0.0F ? 1.0F / (squared - rimDepth * sphere.radius * std::sqrt(squared)) : 0.0F;
}

float rimOf(const EllipsoidRays& rays, float rimDepth) {
  // The plane Qc·(x − c) = −t·√(cᵀQc).
  const float squared = rays.room + 1.0F;
  return rimDepth > 0.0F ? 1.0F / (squared - rimDepth * std::sqrt(squared)) : 0.0F;
}

float backRimOf(const ViewSphere& sphere, float rimDepth) {
  const float squared = sphere.x * sphere.x + sphere.y * sphere.y + sphere.z * sphere.z;
  return rimDepth > 0.0F ? 1.0F / (squared + rimDepth * sphere.radius * std::sqrt(squared)) : kNoBackRim;
}

float backRimOf(const EllipsoidRays& rays, float rimDepth) {
  const float squared = rays.room + 1.0F;
  return rimDepth > 0.0F ? 1.0F / (squared + rimDepth * std::sqrt(squared)) : kNoBackRim;
}

SLUICE_SIMD_CLONES void drawDepthRow(const ViewSphere& sphere, float rim, float slopeY, const float* __restrict slopes,
                                     float* __restrict q, int count) {
  const SphereRow row = sphereRow(sphere, slopeY);
  const float inverse = 1.0F / (row.cx * row.cx + row.cy * row.cy + row.cz * row.cz - row.squaredRadius);
  for (int first = 0; first < count; first += kSplatBlock) {
#pragma GCC ivdep
    for (int i = first; i < first + kSplatBlock; ++i) {
      const float d = discriminant(row, slopes[i]);
      const float root = std::sqrt(std::max(d, 0.0F));
      const float middle = row.rowMiddle + row.cx * slopes[i];
      q[i] = std::max(q[i], d >= 0.0F ? std::max((middle + root) * inverse, middle * rim) : 0.0F);
    }
  }
}

SLUICE_SIMD_CLONES void drawBackRow(const ViewSphere& sphere, float rim, float slopeY, const float* __restrict slopes,
                                    float* __restrict q, int count) {
  const SphereRow row = sphereRow(sphere, slopeY);
  const float inverse = 1.0F / (row.cx * row.cx + row.cy * row.cy + row.cz * row.cz - row.squaredRadius);
  for (int first = 0; first < count; first += kSplatBlock) {
#pragma GCC ivdep
    for (int i = first; i < first + kSplatBlock; ++i) {
      const float d = discriminant(row, slopes[i]);
      const float root = std::sqrt(std::max(d, 0.0F));
      const float middle = row.rowMiddle + row.cx * slopes[i];
      const float back = std::min((middle - root) * inverse, middle * rim);
      q[i] = d >= 0.0F ? std::min(q[i], back) : q[i];
    }
  }
}

SLUICE_SIMD_CLONES void drawBackRow(const EllipsoidRays& rays, const ViewEllipsoid& ellipsoid, float rim, float slopeY,
                                    const float* __restrict slopes, float* __restrict q, int count) {
  const EllipsoidRow row = ellipsoidRow(rays, ellipsoid, slopeY);
  const float inverse = 1.0F / rays.room;
  for (int first = 0; first < count; first += kSplatBlock) {
#pragma GCC ivdep
    for (int i = first; i < first + kSplatBlock; ++i) {
      const float x = slopes[i];
      const float d = discriminant(row, x, squaredLength(row, x));
      const float root = std::sqrt(std::max(d, 0.0F));
      const float middle = row.m0 + row.m1 * x;
      const float back = std::min((middle - root) * inverse, middle * rim);
      q[i] = d >= 0.0F ? std::min(q[i], back) : q[i];
    }
  }
}

SLUICE_SIMD_CLONES void drawDiscBackRow(const ViewSphere& sphere, float slopeY, const float* __restrict slopes,
                                        float* __restrict q, int count) {
  const float ey = sphere.y - sphere.z * slopeY;
  const float room = sphere.radius * sphere.radius - ey * ey;
  const float depth = sphere.z;
  const float x = sphere.x;
  const float inverse = 1.0F / depth;
  for (int first = 0; first < count; first += kSplatBlock) {
#pragma GCC ivdep
    for (int i = first; i < first + kSplatBlock; ++i) {
      const float ex = x - depth * slopes[i];
      q[i] = ex * ex <= room ? std::min(q[i], inverse) : q[i];
    }
  }
}

SLUICE_SIMD_CLONES void drawChordRow(const ViewSphere& sphere, float weight, float slopeY,
                                     const float* __restrict slopes, float* __restrict sum, int count) {
  // z = (m ± √D)/a with a = 1+|W|², so that half the chord is √D/√a.
  const SphereRow row = sphereRow(sphere, slopeY);
  for (int first = 0; first < count; first += kSplatBlock) {
#pragma GCC ivdep
    for (int i = first; i < first + kSplatBlock; ++i) {
      sum[i] += weight * std::sqrt(std::max(discriminant(row, slopes[i]), 0.0F));
    }
  }
}

SLUICE_SIMD_CLONES void drawDepthRow(const EllipsoidRays& rays, const ViewEllipsoid& ellipsoid, float rim, float slopeY,
                                     const float* __restrict slopes, float* __restrict q, int count) {
  const EllipsoidRow row = ellipsoidRow(rays, ellipsoid, slopeY);
  const float inverse = 1.0F / rays.room;
  for (int first = 0; first < count; first += kSplatBlock) {
#pragma GCC ivdep
    for (int i = first; i < first + kSplatBlock; ++i) {
      const float x = slopes[i];
      const float d = discriminant(row, x, squaredLength(row, x));
      const float root = std::sqrt(std::max(d, 0.0F));
      const float middle = row.m0 + row.m1 * x;
      q[i] = std::max(q[i], d >= 0.0F ? std::max((middle + root) * inverse, middle * rim) : 0.0F);
    }
  }
}

SLUICE_SIMD_CLONES void drawChordRow(const EllipsoidRays& rays, const ViewEllipsoid& ellipsoid, float weight,
                                     float slopeY, const float* __restrict slopes, float* __restrict sum, int count) {
  // Half the chord is √D/a·√(1+|W|²).
  const EllipsoidRow row = ellipsoidRow(rays, ellipsoid, slopeY);
  const float rowLength = 1.0F + slopeY * slopeY;
  for (int first = 0; first < count; first += kSplatBlock) {
#pragma GCC ivdep
    for (int i = first; i < first + kSplatBlock; ++i) {
      const float x = slopes[i];
      const float a = squaredLength(row, x);
      const float d = std::max(discriminant(row, x, a), 0.0F);
      sum[i] += weight * std::sqrt(d) * (rowLength + x * x) / a;
    }
  }
}

SLUICE_SIMD_CLONES void drawDiscRow(const ViewSphere& sphere, float slopeY, const float* __restrict slopes,
                                    float* __restrict q, int count) {
  const float ey = sphere.y - sphere.z * slopeY;
  const float room = sphere.radius * sphere.radius - ey * ey;
  const float depth = sphere.z;
  const float x = sphere.x;
  const float inverse = 1.0F / depth;
  for (int first = 0; first < count; first += kSplatBlock) {
#pragma GCC ivdep
    for (int i = first; i < first + kSplatBlock; ++i) {
      const float ex = x - depth * slopes[i];
      q[i] = std::max(q[i], ex * ex <= room ? inverse : 0.0F);
    }
  }
}

SLUICE_SIMD_CLONES void finishChords(const float* __restrict sum, const float* __restrict slopes, float slopeY,
                                     float* __restrict thickness, int count) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    thickness[i] += 2.0F * sum[i] / std::sqrt(1.0F + slopes[i] * slopes[i] + slopeY * slopeY);
  }
}

}  // namespace sluice::render
