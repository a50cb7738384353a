#pragma once

#include <cstdint>

#include "particles.h"

namespace sluice::sim {

/// How a wall answers the pressure of a particle beside it.
enum class WallAnswer {
  Once,     ///< With the particle's own pressure impulse, as often as density counts the wall.
  Mirrored  ///< As WallContact says.
};

/// Sums over the boundary particles b that one particle i feels, x_ib = x_i - x_b.
struct WallSums {
  Float4 gradient;  ///< Σ_b V_b ∇W_ib, 1/m.
  // Of N = -Σ_b V_b ∇W_ib x_ibᵀ: the wall's share in what makes gradients of linear fields exact, 1 of all.
  float xx = 0;
  float yy = 0;
  float zz = 0;
  float xy = 0;
  float xz = 0;
  float yz = 0;
};

/// What a wall is to the pressure of one particle beside it. It is a mirror: behind it liquid of the same pressure
/// comes as fast as the particle does, so that it pushes with κ_i + κ_i and compresses at twice the rate, both by the
/// same gradient, and the force stays the adjoint of the rate. (A wall that answers once leaves a lattice out of
/// balance beside it: the lowest rows sink until they carry twice the liquid's pressure.)
///
/// Along the wall the mirrored liquid has the gradient of pressure that the particle's own neighbours have, which the
/// sum over them misses, since κ_i stands for all that is behind the wall: of a pressure p along it the particle feels
/// (1 - N) ∇p alone. Left so, liquid falls along upright walls, in their edges above all, and rises in the middle. With
/// P onto the plane of the wall, M = (1 - P N P)⁻¹ makes up for it as if the particle were lighter along the wall; the
/// system D M D* stays symmetric and positive.
///
/// The mirror holds to the first order in the change of density in a step. Where a particle is compressed, relief at
/// twice the rate would be believed and not come: there the wall goes back to answering once.
struct WallContact {
  std::uint32_t particle = 0;
  float xx = 0;  ///< Of M - 1.
  float yy = 0;
  float zz = 0;
  float xy = 0;
  float xz = 0;
  float yz = 0;

  /// M v - v.
  Float4 surplus(const Float4& v) const {
    return {xx * v.x + xy * v.y + xz * v.z, xy * v.x + yy * v.y + yz * v.z, xz * v.x + yz * v.y + zz * v.z, 0};
  }
};

/// How often the wall's gradient counts, 1 to 2, beside a particle with the normalised density `density`.
float wallMirror(float density);

/// Of a particle whose wall counts `mirror` times.
WallContact wallContact(std::uint32_t particle, const WallSums& sums, float mirror);

}  // namespace sluice::sim
