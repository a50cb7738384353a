#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <variant>

#include "sluice/app/live_scene.h"
#include "sluice/core/particle_source.h"
#include "sluice/v1/session.pb.h"

namespace sluice::app {

/// What viewers may ask of a run.
using SceneCommand = std::variant<v1::Control, v1::UpdateScene, v1::LoadScene, v1::Interact>;

/// A scene, its particle source, and how far it has come: what a run is, without its pace. The same commands after the
/// same steps give the same particles, bit for bit. For one thread.
class SceneRun {
 public:
  /// Opens the source (throws core::InputError). Viewers' scenes may have `mostParticles`. `threads` 0 means one for
  /// each core.
  SceneRun(LiveScene live, int threads, std::uint64_t mostParticles);

  struct Outcome {
    bool sceneChanged = false;
    bool restarted = false;       ///< The particles started again.
    bool particlesAdded = false;  ///< There are more than before, without a step.
  };

  /// Throws core::InputError, and changes nothing, for what cannot be done.
  Outcome apply(const SceneCommand& command);

  /// One step, whether or not it plays. False at the end of what there is.
  bool advance();

  const std::shared_ptr<const LiveScene>& scene() const { return live_; }
  const core::ParticleSource& source() const { return *source_; }
  bool playing() const { return playing_; }
  bool atEnd() const { return atEnd_; }
  /// Steps since the source was opened or reset.
  std::uint64_t steps() const { return steps_; }
  /// A Control STEP asks for steps up to this time and it is not reached; else −infinity.
  double goal() const { return goal_; }
  bool hasGoal() const;

 private:
  Outcome apply(const v1::Control& control);
  Outcome apply(const v1::UpdateScene& update);
  Outcome apply(const v1::LoadScene& load);
  Outcome apply(const v1::Interact& interact);
  void take(LiveScene live, std::unique_ptr<core::ParticleSource> source);
  void publish(LiveScene live);
  void reset();
  void setGoal(double seconds);

  const int threads_;
  const std::uint64_t mostParticles_;
  std::shared_ptr<const LiveScene> live_;
  std::unique_ptr<core::ParticleSource> source_;
  bool playing_ = true;
  bool atEnd_ = false;
  std::uint64_t steps_ = 0;
  double goal_;
};

}  // namespace sluice::app
