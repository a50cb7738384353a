#pragma once

#include <cstdint>
#include <memory>

#include "sluice/sim/step_plan.h"
#include "sluice/v1/scene.pb.h"
#include "step_context.h"

namespace sluice::sim {

/// One way to keep a fluid incompressible. The stages that are its own (see planStep) come to `run`, in the order of
/// the plan; a stage that sets `trouble` has the step taken back. Used by one thread.
class PressureSolver {
 public:
  virtual ~PressureSolver() = default;

  /// Makes the initial particles carry what it needs of them. Called before the first pairs are found.
  virtual void reset(ParticleState& state, const Container& container);

  /// Live parameters of a scene with the same solver.
  virtual void update(const v1::Simulation& simulation) = 0;

  virtual void run(Stage stage, StepContext& step) = 0;

  /// Speed of sound that bounds the step, m/s; 0 where pressure acts at once.
  virtual double speedOfSound() const { return 0; }

  /// Its stages change positions after the particles have moved.
  virtual bool movesParticles() const { return false; }

  /// How static walls count in the gradient sums that it is given.
  virtual WallAnswer wallAnswer() const { return WallAnswer::Once; }

  /// It mirrors all walls by itself, moving bodies among them. Where a wall answers once, a particle beside it carries
  /// more than the pressure that is there.
  virtual bool mirrorsByItself() const { return false; }

  /// Memory that it holds besides the particles' state, bytes.
  virtual std::uint64_t bytes() const = 0;
};

/// The solver that a scene asks for.
std::unique_ptr<PressureSolver> makePressureSolver(const v1::Simulation& simulation);

}  // namespace sluice::sim
