#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "sluice/core/particle_source.h"
#include "sluice/core/plan.h"
#include "sluice/v1/scene.pb.h"

namespace sluice::app {

/// The scene that runs, frozen: replaced as a whole whenever something in it changes.
struct LiveScene {
  v1::Scene scene;   ///< Complete and valid.
  std::string name;  ///< Of a shipped scene; empty for any other.
  core::Plan steps;  ///< What a step of its source runs.
};

/// A scene as a person names it: a shipped scene, a scene file, or a particle file or sequence, with `--set`
/// assignments applied. Throws core::InputError.
LiveScene loadScene(const std::string& nameOrPath, const std::vector<std::string>& assignments = {});

/// The source of a complete, valid scene. `threads` 0 means one for each core; `mostParticles` 0 as many as there is
/// memory for. Throws core::InputError.
std::unique_ptr<core::ParticleSource> openSource(const v1::Scene& scene, int threads, std::uint64_t mostParticles = 0);

}  // namespace sluice::app
