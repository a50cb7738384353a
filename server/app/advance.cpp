#include "advance.h"

#include <algorithm>

#include "sluice/core/input_error.h"

namespace sluice::app {

namespace {

/// How long what happened shows in a picture: marks of violent particles have then faded to 5 %, e^(−3).
double memorySeconds(const v1::Scene& scene) {
  double seconds = scene.look().has_noise() ? scene.look().noise().cool_down_seconds() : 0.0;
  for (const v1::Look& look : scene.more_looks()) {
    if (look.has_noise()) seconds = std::max(seconds, look.noise().cool_down_seconds());
  }
  return 3 * seconds;
}

}  // namespace

void advanceTo(core::ParticleSource& source, double time) {
  while (source.time() < time && source.advance()) {
  }
  if (!source.halted().empty()) throw core::EnvironmentError("the simulation halted: " + source.halted());
}

void advanceOnto(core::ParticleSource& source, double time) {
  source.stopAt(time);
  advanceTo(source, time);
}

void advanceTo(core::ParticleSource& source, double time, const v1::Scene& scene, render::FluidRenderer& renderer) {
  constexpr double kPace = 0.04;
  const double memory = memorySeconds(scene);
  if (memory > 0) {
    for (double t = std::max(time - memory, 0.0); t < time; t += kPace) {
      advanceTo(source, t);
      renderer.follow(*source.snapshot(), scene);
    }
  }
  advanceTo(source, time);
}

std::unique_ptr<core::ParticleSnapshot> takeSnapshot(const core::ParticleSource& source, std::uint64_t sequence) {
  std::unique_ptr<core::ParticleSnapshot> snapshot = source.snapshot();
  snapshot->sequence = sequence;
  return snapshot;
}

}  // namespace sluice::app
