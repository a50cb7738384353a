#pragma once

#include <cstdint>
#include <string>

#include "discretisation.h"

namespace sluice::sim {

/// Memory that this machine can still give, bytes.
std::uint64_t availableMemory();

/// What a particle takes, bytes: pairs with the particles around it, state twice, sums, and the copy in a snapshot.
std::uint64_t bytesPerParticle(const Discretisation& discretisation);

/// How many particles a scene may have, and why not more.
struct ParticleLimit {
  std::uint64_t count = 0;
  std::uint64_t bytesEach = 0;  ///< That a particle takes, about.
  std::string reason;           ///< What allows so many: "18 GB of free memory allows".

  /// What so many particles would take, and why there may be no more than `count`, for people.
  std::string explain(double particles) const;
};

/// The particles that `freeBytes` of memory hold, no more than an operator allows (0: any number), nor than can be
/// numbered.
ParticleLimit particleLimit(const Discretisation& discretisation, std::uint64_t freeBytes, std::uint64_t allowed);

/// What a boundary particle takes while the boundary is made, bytes.
inline constexpr std::uint64_t kBytesPerBoundaryParticle = 64;

}  // namespace sluice::sim
