#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "sluice/v1/scene.pb.h"
#include "step_context.h"

namespace sluice::sim {

/// One way for surfaces of the fluids to be under tension. Used by one thread.
class SurfaceTension {
 public:
  virtual ~SurfaceTension() = default;

  /// Changes the velocities by a step of tension.
  virtual void apply(const v1::SurfaceTension& settings, StepContext& step) = 0;

  virtual std::uint64_t bytes() const = 0;
};

/// The method that a scene asks for; null where it asks for none.
std::unique_ptr<SurfaceTension> makeSurfaceTension(const v1::Simulation& simulation);

/// The gradient, without a factor, of a field that is 1 in fluid and walls and 0 outside. A wall counts as fluid, which
/// lets fluid wet it without pulling it on.
class ColourGradient {
 public:
  enum class Weight {
    Volume,   ///< Σ_j V_j/ρ̃_j ∇W_ij + Σ_b V_b ∇W_ib: particles with the volumes that they take up.
    Density,  ///< Σ_j V_j ρ̃_j ∇W_ij + Σ_b V_b ∇W_ib: the colours of He et al. 2014.
  };

  void compute(Weight weight, const StepContext& step);

  const std::vector<Float4>& values() const { return gradient_; }
  std::vector<Float4>& values() { return gradient_; }
  /// Σ_j V_j ∇W_ij over the fluid.
  const std::vector<Float4>& ofFluid() const { return ofFluid_; }
  std::uint64_t bytes() const { return (weight_.size() + gradient_.size() + ofFluid_.size()) * sizeof(Float4); }

 private:
  std::vector<Float4> weight_;
  std::vector<Float4> gradient_;
  std::vector<Float4> ofFluid_;
};

}  // namespace sluice::sim
