#include "foam_sums.h"

#include <cmath>

// Compiles a function for several instruction sets and picks the best at run time. The lanes fix the order of every
// sum and nothing fuses multiply-adds, so that every version gives the same bits.
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define SLUICE_FOAM_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define SLUICE_FOAM_CLONES
#endif

namespace sluice::sources {

namespace {

// Helpers of cloned functions must be inlined, or every clone would call the one version for all instruction sets.

struct Lanes {
  float of[kLanes] = {};
};

[[gnu::always_inline]] inline float total(const Lanes& lanes) {
  const float* v = lanes.of;
  return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7]));
}

}  // namespace

SLUICE_FOAM_CLONES
SurroundingSums sumSurroundings(const NearbyLiquid& nearby, const Eigen::Vector3f& point, float support) {
  const float px = point[0];
  const float py = point[1];
  const float pz = point[2];
  const float inverse = 1 / support;
  Lanes count, weight, vx, vy, vz;
  for (std::size_t first = 0; first < nearby.padded(); first += kLanes) {
    const float* x = &nearby.x[first];
    const float* y = &nearby.y[first];
    const float* z = &nearby.z[first];
    const float* u = &nearby.vx[first];
    const float* v = &nearby.vy[first];
    const float* w = &nearby.vz[first];
    for (std::size_t l = 0; l < kLanes; ++l) {
      const float dx = px - x[l];
      const float dy = py - y[l];
      const float dz = pz - z[l];
      const float away = 1 - std::sqrt(dx * dx + dy * dy + dz * dz) * inverse;
      const float near = away > 0 ? away : 0;
      count.of[l] += away > 0 ? 1.0F : 0.0F;
      weight.of[l] += near;
      vx.of[l] += near * u[l];
      vy.of[l] += near * v[l];
      vz.of[l] += near * w[l];
    }
  }
  return {total(count), total(weight), {total(vx), total(vy), total(vz)}};
}

SLUICE_FOAM_CLONES
MotionSums sumMotion(const NearbyLiquid& nearby, const Eigen::Vector3f& point, const Eigen::Vector3f& velocity,
                     float support) {
  const float px = point[0];
  const float py = point[1];
  const float pz = point[2];
  const float pu = velocity[0];
  const float pv = velocity[1];
  const float pw = velocity[2];
  const float inverse = 1 / support;
  Lanes count, approach, nx, ny, nz;
  for (std::size_t first = 0; first < nearby.padded(); first += kLanes) {
    const float* x = &nearby.x[first];
    const float* y = &nearby.y[first];
    const float* z = &nearby.z[first];
    const float* u = &nearby.vx[first];
    const float* v = &nearby.vy[first];
    const float* w = &nearby.vz[first];
    for (std::size_t l = 0; l < kLanes; ++l) {
      const float dx = px - x[l];
      const float dy = py - y[l];
      const float dz = pz - z[l];
      const float du = pu - u[l];
      const float dv = pv - v[l];
      const float dw = pw - w[l];
      const float distance = std::sqrt(dx * dx + dy * dy + dz * dz);
      const float away = 1 - distance * inverse;
      const float near = away > 0 ? away : 0;
      // 0/1 instead of 0/0 for what coincides.
      const float along = (du * dx + dv * dy + dw * dz) / (distance > 0 ? distance : 1.0F);
      const float speed = std::sqrt(du * du + dv * dv + dw * dw);
      count.of[l] += away > 0 ? 1.0F : 0.0F;
      approach.of[l] += near * (speed - along);
      nx.of[l] += near * dx;
      ny.of[l] += near * dy;
      nz.of[l] += near * dz;
    }
  }
  return {total(count), total(approach), {total(nx), total(ny), total(nz)}};
}

SLUICE_FOAM_CLONES
BendSums sumBend(const NearbyLiquid& nearby, const NearbyNormals& normals, const Eigen::Vector3f& point,
                 const Eigen::Vector3f& normal, float support) {
  const float px = point[0];
  const float py = point[1];
  const float pz = point[2];
  const float pu = normal[0];
  const float pv = normal[1];
  const float pw = normal[2];
  const float inverse = 1 / support;
  Lanes weight, bend;
  for (std::size_t first = 0; first < nearby.padded(); first += kLanes) {
    const float* x = &nearby.x[first];
    const float* y = &nearby.y[first];
    const float* z = &nearby.z[first];
    const float* u = &normals.x[first];
    const float* v = &normals.y[first];
    const float* w = &normals.z[first];
    for (std::size_t l = 0; l < kLanes; ++l) {
      const float dx = x[l] - px;
      const float dy = y[l] - py;
      const float dz = z[l] - pz;
      const float away = 1 - std::sqrt(dx * dx + dy * dy + dz * dz) * inverse;
      const float length = u[l] * u[l] + v[l] * v[l] + w[l] * w[l];
      const float near = (away > 0 ? away : 0) * (length > 0.5F ? 1.0F : 0.0F);
      const float behind = dx * pu + dy * pv + dz * pw < 0 ? near : 0;
      weight.of[l] += near;
      bend.of[l] += behind * (1 - (u[l] * pu + v[l] * pv + w[l] * pw));
    }
  }
  return {total(weight), total(bend)};
}

}  // namespace sluice::sources
