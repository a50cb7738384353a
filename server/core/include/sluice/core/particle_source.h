#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sluice/core/flow_measures.h"
#include "sluice/core/interaction.h"
#include "sluice/core/particle_snapshot.h"
#include "sluice/core/plan.h"
#include "sluice/core/state_stream.h"

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

  /// Has the steps of a source that chooses their lengths itself end at `seconds` exactly where they would pass it: the
  /// time of a picture, or of a file. Holds until it is called again, with infinity for no such time; times that lie
  /// behind have no effect. Stored frames are where they are.
  virtual void stopAt(double /*seconds*/) {}

  /// Simulated time, s, 0 in the initial state.
  virtual double time() const = 0;

  /// Back to the initial state.
  virtual void reset() = 0;

  /// A frozen copy of the present state. `sequence` is left 0 for the owner to fill in.
  virtual std::unique_ptr<ParticleSnapshot> snapshot() const = 0;

  /// How the last step went; sources that can tell without copying their particles do.
  virtual StepStatistics statistics() const { return snapshot()->statistics; }

  /// What tells of the error of the flow as it is now; costs a pass over the particles. Zeros where a source has no
  /// flow.
  virtual FlowMeasures measures() const { return {}; }

  /// Takes over the live fields of a complete, valid scene; the caller restarts the source where a field that needs
  /// it has changed. Throws InputError, and keeps its state, where a value cannot be taken.
  virtual void update(const v1::Scene& scene) = 0;

  /// Touches the fluid, from the next step on. Throws InputError, and changes nothing, where that cannot be done.
  virtual void interact(const Interaction& /*interaction*/) {
    throw InputError("", "interact", "only the fluid of a simulation can be touched");
  }

  /// Why the source can not go on; empty while it can.
  virtual std::string halted() const { return {}; }

  /// Writes everything that the next steps depend on. Throws InputError where a source has no such state.
  virtual void save(StateWriter& /*out*/) const {
    throw InputError("", "source", "only the state of a simulation can be saved");
  }

  /// Takes over what a source of the same scene has saved: from here on it goes the way of that one, bit for bit.
  /// Throws InputError for a state of another scene; the source then is of no use any more.
  virtual void resume(StateReader& in) { in.fail("only a simulation can be resumed"); }

  /// What the source had to change in what the scene asks for, or takes in a way that a person may not expect: a
  /// sentence each, known from the start on.
  virtual std::vector<std::string> notices() const { return {}; }

  /// What a step does and what it leaves out.
  virtual Plan plan() const = 0;
};

}  // namespace sluice::core
