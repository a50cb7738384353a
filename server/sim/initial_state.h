#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bodies.h"
#include "container.h"
#include "particles.h"
#include "sluice/v1/scene.pb.h"

namespace sluice::sim {

struct InitialState {
  ParticleState particles;
  std::vector<std::string> blocks;       ///< Field paths, "simulation.fluids[0].blocks[1]", in the particles' order.
  std::vector<std::uint64_t> blockEnds;  ///< Of each block: one past its last particle.
  std::vector<std::uint64_t> takenOut;   ///< Of each body: particles that would have started in it, or too near to it.

  /// The block that a particle comes from.
  const std::string& blockOf(std::uint32_t id) const;
};

/// The particles of all blocks, in the order of the blocks, x fastest, without those that would start in a body or
/// nearer than half a spacing to its surface. Throws core::InputError where a block does not stand inside the container
/// with a spacing to its faces or, in a planar scene, not in its plane, where bodies leave nothing of it, or where
/// there are more particles than `particleLimit`.
InitialState initialState(const v1::Simulation& simulation, const Container& container, const Bodies& bodies,
                          std::uint64_t particleLimit);

}  // namespace sluice::sim
