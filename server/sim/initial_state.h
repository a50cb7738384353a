#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bodies.h"
#include "container.h"
#include "memory_budget.h"
#include "particles.h"
#include "sluice/v1/scene.pb.h"

namespace sluice::sim {

/// What becomes of volumes that do not fit.
enum class VolumeFit : std::uint8_t {
  AsGiven,   ///< They are refused.
  Refilled,  ///< Filled at another spacing than the scene's (see atQuality), on one lattice: what is too near to the
             ///< container's faces is left out, and what an earlier volume has filled already.
};

struct InitialState {
  /// Of which volume (block, ball, mesh) particles are.
  struct Origin {
    std::string noun;       ///< "block".
    std::string path;       ///< "simulation.fluids[0].blocks[1]".
    std::string place;      ///< Field path of where it is.
    std::uint64_t end = 0;  ///< One past its last particle.
  };

  ParticleState particles;
  std::vector<Origin> origins;          ///< In the particles' order.
  std::vector<std::uint64_t> takenOut;  ///< Of each body: particles that would have started in it, or too near to it.
  std::uint64_t misfits = 0;            ///< Particles left out as VolumeFit::Refilled says.

  /// The volume that a particle comes from.
  const Origin& originOf(std::uint32_t id) const;
};

/// The particles of all volumes (see fluidVolumes), without those that would start in a body or nearer than half a
/// spacing to its surface. A scene that has emitters may start without any. Throws core::InputError where a volume does
/// not stand inside the container with a spacing to its faces (unless `fit` says otherwise) or, in a planar scene, not
/// in its plane; where bodies or faces leave nothing of it; and where there are more particles
/// than `limit`, or than the scene's `max_particles`.
InitialState initialState(const v1::Simulation& simulation, const Container& container, const Bodies& bodies,
                          const ParticleLimit& limit, VolumeFit fit = VolumeFit::AsGiven);

}  // namespace sluice::sim
