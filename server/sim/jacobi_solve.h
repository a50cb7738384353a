#pragma once

#include <cstdint>
#include <vector>

#include "neighbour_lists.h"
#include "particles.h"
#include "team.h"

namespace sluice::sim {

class BodyCoupling;

/// What a solve has to reach.
struct SolveGoal {
  /// ρ̃ of every particle for the density solve (nothing may be compressed after `seconds`); null for the divergence
  /// solve (nothing may be compressing).
  const std::vector<float>* density = nullptr;
  double seconds = 0;  ///< Time step, s.
  /// Mean over all particles of the compression that is left, relative to the rest density, at which it stops.
  double tolerance = 0;
  std::uint32_t minIterations = 1;
  std::uint32_t maxIterations = 100;
  BodyCoupling* bodies = nullptr;  ///< Moving bodies that answer to the impulses; null where there are none near.
  double relaxation = 0.5;         ///< ω. Plain Jacobi (1) diverges on dense clusters, Bender & Koschier take 1/2.
};

struct SolveOutcome {
  std::uint32_t iterations = 0;
  double meanError = 0;  ///< Mean predicted compression left by the velocities that the solve hands back.
  double maxError = 0;
};

/// Relaxed Jacobi iteration for pressure impulses κ ≥ 0,
///
///   u_i = v_i - w_i M_i [Σ_j V_j (κ_i + κ_j) ∇W_ij + κ_i Σ_b s_i V_b ∇W_ib],   κ_i > 0 only where the bound is met,
///   (D u)_i = Σ_j V_j (u_i - u_j)·∇W_ij + Σ_b s_i V_b u_i·∇W_ib ≤ bound_i,
///
/// (a static boundary counts as often in the one as in the other, s_i times, which makes the impulses the exact adjoint
/// of D: pressure then does no work, where a mirrored κ_i alone was seen to add energy at impacts; s_i and M_i, 1 away
/// from walls, are those of WallContact) with bound (1 - ρ̃_i)/dt in a density solve and 0 in a
/// divergence solve; w_i is the particle's mobility (see Mixture). In terms of the masses m ∝ 1/w, u is the nearest to
/// v in Σ m |u - v|² that meets the bounds: the system is D M⁻¹ Dᵀ, with the diagonal 1/α_i = w_i |Σ_j V_j ∇W_ij + Σ_b
/// V_b ∇W_ib|² + Σ_j w_j |V_j ∇W_ij|². Floating bodies are unknowns like the particles: each iteration gives them the
/// twists that its impulses leave them with (see BodyCoupling), so that a light body is as stable as a heavy one. The
/// velocities handed back are those whose error was measured, not an iterate later.
///
/// Each iterate is extrapolated along the way from the last one [BT09: Beck & Teboulle 2009, A fast iterative
/// shrinkage-thresholding algorithm], from the beginning again wherever that runs past the solution [OC15: O'Donoghue &
/// Candès 2015, Adaptive restart for accelerated gradient schemes]: pressure crosses a column in about as many
/// iterations as it has layers, where plain Jacobi takes their square.
class JacobiSolve {
 public:
  /// `velocity` and `impulse` (the start of the iteration, m²/s) are replaced by the result. Particles whose `factor`
  /// α_i is 0 carry no pressure and do not count.
  SolveOutcome run(const SolveGoal& goal, const NeighbourLists& lists, const Mobility& mobility,
                   const std::vector<float>& factor, std::vector<Float4>& velocity, std::vector<float>& impulse,
                   const Team& team);

  std::uint64_t bytes() const { return (impulse4_.size() + result_.size()) * sizeof(Float4); }

 private:
  std::vector<Float4> impulse4_;  ///< κ in all four lanes, for the pair loops.
  std::vector<Float4> result_;
};

}  // namespace sluice::sim
