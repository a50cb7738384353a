#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "discretisation.h"
#include "particles.h"
#include "wall_contact.h"

namespace sluice::sim {

/// Four neighbours j of one particle i with their weighted kernel gradients V ∇W_ij, as integers in units of
/// `PairScale::quantum`: 12 bytes a pair instead of 20, because the loops over pairs are bound by memory.
///
/// The rounding is at most 5·10⁻⁶ of the lattice's 1/d per component, which is 10⁻⁵ of density at the largest step
/// that the CFL bound allows: a fiftieth of the tolerance. Integers negate exactly and add up exactly, so ∇W_ij =
/// -∇W_ji holds to the last bit and momentum is kept; and every loop uses the same rounded gradients, so that the
/// pressure operator stays exactly D Dᵀ.
///
/// A list whose length is no multiple of four ends with pairs (i, i) of gradient 0.
struct alignas(16) PairGroup {
  std::uint32_t neighbour[4];
  std::int16_t gradient[4][4];  ///< [pair][x, y, z, 0].
};
static_assert(sizeof(PairGroup) == 48);

/// Constants of a kernel, support and particle volume.
struct PairScale {
  PairScale() = default;
  /// `period` is the size of a periodic box, 0 along axes that are not periodic, m.
  explicit PairScale(const Discretisation& discretisation, const std::array<double, 3>& period = {});

  KernelKind kernel = KernelKind::CubicSpline;
  float support = 0;         ///< H, m.
  float value = 0;           ///< V k: a normalised density is this times Σ f(q).
  float slope = 0;           ///< V k/H: V dW/dr is this times f'(q), 1/m.
  float quantum = 0;         ///< Unit of the integer gradients, 1/m.
  float inverseQuantum = 0;  ///< m.
  bool periodic = false;
  Float4 period;      ///< m; 0 along axes that are not periodic.
  Float4 halfPeriod;  ///< m; infinite along them.
};

/// Candidates for the neighbours of all particles of one cell, as structure of arrays. Padded with points far away to
/// a multiple of kLanes, plus kLanes more; `slots` has room for as many.
struct Candidates {
  static constexpr std::size_t kLanes = 16;

  const float* x;
  const float* y;
  const float* z;
  const float* volume;         ///< Of boundary particles, as multiples of a fluid particle's; null for fluid.
  const std::uint32_t* index;  ///< Of fluid particles; null for boundary.
  std::uint32_t* slots;        ///< Scratch of the search.
  std::size_t count;
};

/// Sums over the pairs of a particle that every step needs. Arrays over all particles.
struct PairSums {
  float* density;             ///< Normalised density ρ̃ = ρ/ρ0.
  Float4* gradientSum;        ///< D_i = Σ_j V_j ∇W_ij + Σ_b V_b ∇W_ib, 1/m.
  float* gradientSquares;     ///< Σ_j |V_j ∇W_ij|², 1/m².
  std::uint16_t* groups;      ///< Number of PairGroups.
  std::uint16_t* neighbours;  ///< Number of neighbours.
};

/// The pairs of particles [first, last): `groups` holds theirs one after the other.
struct PairList {
  const PairGroup* groups;
  const std::uint16_t* groupCount;  ///< Array over all particles.
  std::uint32_t first;
  std::uint32_t last;
  float quantum;
};

/// Fluids that a simulation may hold.
inline constexpr std::size_t kMostFluids = 8;

/// How far one pressure impulse moves a particle: w_i = `ofFluid[fluid[i]]`, in inverse proportion to its mass.
struct Mobility {
  const std::uint8_t* fluid = nullptr;  ///< Array over all particles; null where w = 1 for all.
  std::array<float, kMostFluids> ofFluid{};
};

/// How strongly a particle of one fluid (first index) feels one of another.
struct PairStrength {
  const std::uint8_t* fluid = nullptr;  ///< Array over all particles; null where strength[0][0] is that of all pairs.
  std::array<std::array<float, kMostFluids>, kMostFluids> strength{};
};

/// Cohesion and the evening out of normals, Akinci et al. 2013.
struct Cohesion {
  PairStrength strength;  ///< Change of velocity at a cohesion of 1, m/s.
  float curvature = 0;    ///< Change of velocity at a difference of normals of 1, over that.
};

/// Exchange of spin and velocity in a micropolar fluid.
struct SpinExchange {
  float transfer = 0;   ///< ν_t dt, m².
  float spinUp = 0;     ///< Θ⁻¹ ν_t dt.
  float smoothing = 0;  ///< ζ.
};

/// What a chunk contributes to the error of a pressure solve.
struct SolveError {
  double sum = 0;     ///< Σ max(error_i, 0).
  float largest = 0;  ///< max error_i.

  SolveError& operator+=(const SolveError& other) {
    sum += other.sum;
    largest = largest < other.largest ? other.largest : largest;
    return *this;
  }
};

/// The loops over pairs, compiled once for each instruction set. All versions give the same bits: they run the same
/// sequence of operations on lanes whose number is fixed by the data layout, and never use fused multiply-adds or
/// approximate reciprocals. `Float4` arrays are over all particles. Thread-safe for disjoint ranges of particles.
struct PairLoops {
  std::string_view instructionSet;

  /// Finds the neighbours of particles [first, last), which share the cell that `candidates` were gathered for, writes
  /// their pairs to `out` and their sums without boundary. `out` has room for all candidates of each particle.
  /// Returns the end of what was written.
  PairGroup* (*findNeighbours)(const PairScale&, const Candidates&, const Float4* position, std::uint32_t first,
                               std::uint32_t last, PairGroup* out, const PairSums&);

  /// Adds the boundary particles among `candidates` to the sums of particles [first, last).
  void (*addBoundary)(const PairScale&, const Candidates&, const Float4* position, std::uint32_t first,
                      std::uint32_t last, const PairSums&);

  /// As addBoundary, but to densities and neighbours alone: what mirrors are made of goes to `walls`, the first
  /// particle's first.
  void (*weighBoundary)(const PairScale&, const Candidates&, const Float4* position, std::uint32_t first,
                        std::uint32_t last, const PairSums&, WallSums* walls);

  /// Writes Σ_j w_j |V_j ∇W_ij|², 1/m². `mobility` has fluids.
  void (*weighSquares)(const PairList&, const Mobility& mobility, float* result);

  /// u_i = v_i - w_i (κ_i D_i + Σ_j κ_j V ∇W_ij): velocities after the pressure impulses κ (in all four lanes of a
  /// Float4), m²/s.
  void (*applyImpulses)(const PairList&, const Mobility&, const Float4* impulse, const Float4* gradientSum,
                        const Float4* velocity, Float4* result);

  /// One Jacobi step of κ, relaxed by ω, towards a density rate (D u)_i = u_i·D_i - Σ_j u_j·V ∇W_ij of at most
  /// (1 - ρ̃_i)/`seconds`, or of at most 0 where `density` is null. Particles of factor 0 keep κ = 0. Returns the error
  /// before the step: the excess of the rate times `seconds`.
  SolveError (*relaxImpulses)(const PairList&, const Float4* velocity, const Float4* gradientSum, const float* factor,
                              const float* density, float seconds, float relaxation, Float4* impulse);

  /// rate_i = (D u)_i, 1/s: how fast the normalised density of a particle grows.
  void (*densityRate)(const PairList&, const Float4* velocity, const Float4* gradientSum, float* rate);

  /// result_i = Σ_j strength_ij (a_i - a_j) (x_ij·V∇W_ij) / (|x_ij|² + 0.01 H²), with a in the fourth lane of the
  /// positions.
  void (*diffuse)(const PairList&, const PairScale&, const PairStrength&, const Float4* positionAndValue,
                  float* result);

  /// result_i = Σ_j y_j V ∇W_ij, with y in all four lanes of a Float4.
  void (*weightedGradient)(const PairList&, const Float4* weight, Float4* result);

  /// result_i = v_i + Σ_j strength_ij (v_ij·V∇W_ij) x_ij / (|x_ij|² + 0.01 H²); strengths in m².
  void (*applyViscosity)(const PairList&, const PairScale&, const PairStrength&, const Float4* position,
                         const Float4* velocity, Float4* result);

  /// The 3×3 matrices Σ_j strength_ij x_ij V∇W_ijᵀ / (|x_ij|² + 0.01 H²), three columns for each particle.
  void (*viscosityBlocks)(const PairList&, const PairScale&, const PairStrength&, const Float4* position,
                          Float4* columns);

  /// result_i = v_i - Σ_j strength_ij K_ij [C(|x_ij|) x_ij/|x_ij| + curvature (n_i - n_j)], K_ij = 2/(ρ̃_i + ρ̃_j), with
  /// ρ̃ in the fourth lane of the positions. C(qH) = (1-q)³q³ for q > ½, 2(1-q)³q³ - 1/64 below.
  void (*cohere)(const PairList&, const PairScale&, const Cohesion&, const Float4* positionAndDensity,
                 const Float4* normal, const Float4* velocity, Float4* result);

  /// v_i - ν_t dt Σ_j (ω_i + ω_j) × V∇W_ij, and
  /// (ω_i + Θ⁻¹ν_t dt Σ_j (v_i - v_j) × V∇W_ij - ζ Σ_j V W_ij (ω_i - ω_j)) / (1 + 2 Θ⁻¹ν_t dt).
  void (*exchangeSpin)(const PairList&, const PairScale&, const SpinExchange&, const Float4* position,
                       const Float4* velocity, const Float4* spin, Float4* velocityResult, Float4* spinResult);
};

/// The fastest loops that this machine can run.
const PairLoops& bestPairLoops();

/// All loops that this machine can run, slowest first.
std::vector<const PairLoops*> availablePairLoops();

}  // namespace sluice::sim
