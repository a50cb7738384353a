#pragma once

#include <cstdint>
#include <memory>

#include "sluice/core/particle_source.h"
#include "sluice/render/fluid_renderer.h"
#include "sluice/v1/scene.pb.h"

namespace sluice::app {

/// Steps to the first state at or after `time`, s. Throws core::EnvironmentError where the source halts before.
void advanceTo(core::ParticleSource& source, double time);

/// Steps to `time` exactly, where the source chooses its own steps, as an animation's frames are to be evenly spaced.
void advanceOnto(core::ParticleSource& source, double time);

/// The same as advanceTo for one picture: the renderer learns, at the pace of a film, how the particles have moved
/// before it.
void advanceTo(core::ParticleSource& source, double time, const v1::Scene& scene, render::FluidRenderer& renderer);

/// The present state under a number of its own, by which the renderer knows particles that it has seen.
std::unique_ptr<core::ParticleSnapshot> takeSnapshot(const core::ParticleSource& source, std::uint64_t sequence);

}  // namespace sluice::app
