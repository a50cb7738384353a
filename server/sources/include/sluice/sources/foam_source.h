#pragma once

#include <memory>

#include "sluice/core/particle_source.h"
#include "sluice/v1/scene.pb.h"

namespace sluice::sources {

/// A source whose snapshots also hold the spray, foam and bubbles that its liquid makes, as the complete, valid scene's
/// `foam` says. Without it, and where the source tells no velocities, snapshots are as they were and cost nothing more.
/// The secondary particles depend on the scene, its seed and the liquid alone, bit for bit, whatever `threads` (0: one
/// for each core).
std::unique_ptr<core::ParticleSource> withFoam(std::unique_ptr<core::ParticleSource> liquid, const v1::Scene& scene,
                                               int threads = 0);

}  // namespace sluice::sources
