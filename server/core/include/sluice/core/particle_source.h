#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sluice/core/particle_snapshot.h"
#include "sluice/core/plan.h"

namespace sluice::v1 {
class Scene;
}

namespace sluice::core {

/// Anything that gives particles over time: a solver, or a stored sequence. Owned and used by one thread.
class ParticleSource {
 public:
  virtual ~ParticleSource() = default;

  /// Moves on by one time step (or one stored frame). Returns false when there is nothing to move on to: the end of
  /// a sequence, a single file, or a simulation that halted (see `halted`).
  virtual bool advance() = 0;

  /// Simulated time, s, 0 in the initial state.
  virtual double time() const = 0;

  /// Back to the initial state.
  virtual void reset() = 0;

  /// A frozen copy of the present state. `sequence` is left 0 for the owner to fill in.
  virtual std::unique_ptr<ParticleSnapshot> snapshot() const = 0;

  /// How the last step went; sources that can tell without copying their particles do.
  virtual StepStatistics statistics() const { return snapshot()->statistics; }

  /// Takes over the live fields of a complete, valid scene; the caller restarts the source where a field that needs
  /// it has changed. Throws InputError, and keeps its state, where a value cannot be taken.
  virtual void update(const v1::Scene& scene) = 0;

  /// Why the source can not go on; empty while it can.
  virtual std::string halted() const { return {}; }

  /// What the source had to change in what the scene asks for, or takes in a way that a person may not expect: a
  /// sentence each, known from the start on.
  virtual std::vector<std::string> notices() const { return {}; }

  /// What a step does and what it leaves out.
  virtual Plan plan() const = 0;
};

}  // namespace sluice::core
