#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sluice/v1/scene.pb.h"
#include "step_context.h"

namespace sluice::sim {

/// Implicit viscosity [Weiler et al. 2018, A physically consistent implicit viscosity solver for SPH fluids]:
/// velocities v with v - dt a(v) = v*, where a is the friction of ExplicitViscosity, by conjugate gradients without a
/// matrix, preconditioned by the 3×3 blocks on the diagonal. The system is symmetric in the inner product Σ m u·v. Its
/// mean is known beforehand, because friction keeps momentum; what the iteration has left over of it is added at the
/// end.
class ImplicitViscosity {
 public:
  /// Changes the velocities by a step of friction. Sets the step's trouble where the iterations ran out far from a
  /// solution.
  void apply(const v1::ImplicitViscosity& settings, StepContext& step);

  std::uint64_t bytes() const;

 private:
  /// A symmetric 3×3 matrix: xx, yy, zz, and xy, yz, zx.
  struct Block {
    std::array<float, 3> diagonal;
    std::array<float, 3> beside;
  };

  void invertBlocks(const PairStrength& friction, const StepContext& step);
  double start(const PairStrength& resistance, const StepContext& step);
  double iterate(const PairStrength& resistance, double alignment, const StepContext& step);
  void keepMomentum(const StepContext& step);
  Float4 precondition(std::size_t i) const;

  std::vector<float> mass_;  ///< Of each fluid, relative.
  std::vector<Float4> residual_, direction_, image_, conditioned_;
  std::vector<Float4> columns_;
  std::vector<Block> inverse_;
  double residualSquare_ = 0;
};

}  // namespace sluice::sim
