#pragma once

#include <cstdint>
#include <memory>

#include "sluice/core/particle_source.h"
#include "sluice/v1/scene.pb.h"

namespace sluice::sim {

/// A fluid simulation, with the scene's bodies as walls, of the complete, valid scene (which must have `simulation`
/// set) in its initial state and at its `quality`. The particles depend on the scene and its seed alone, bit for bit,
/// whatever `threads` (0: one for each core). It has `mostParticles` at most; 0: as many as
/// there is memory for. Throws core::InputError with the field path where the scene cannot be
/// simulated (fluid outside the container, a mesh that cannot be read…).
std::unique_ptr<core::ParticleSource> makeSimulation(const v1::Scene& scene, int threads = 0,
                                                     std::uint64_t mostParticles = 0);

}  // namespace sluice::sim
