#pragma once

#include <cstdint>
#include <string>

#include "container.h"
#include "particles.h"
#include "sluice/v1/scene.pb.h"

namespace sluice::sim {

/// The particles of all blocks, in the order of the blocks, x fastest. Throws core::InputError where a block does not
/// stand inside the container with a spacing to its faces or, in a planar scene, not in its plane, or there are more
/// particles than `particleLimit`.
ParticleState initialState(const v1::Simulation& simulation, const Container& container, std::uint64_t particleLimit);

/// Name of the block that a particle comes from, as a field path ("simulation.fluids[0].blocks[1]").
std::string blockOf(const v1::Simulation& simulation, std::uint32_t id);

}  // namespace sluice::sim
