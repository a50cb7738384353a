#pragma once

#include <cstdint>

#include "discretisation.h"

namespace sluice::sim {

/// Memory that this machine can still give, bytes.
std::uint64_t availableMemory();

/// What a particle takes, bytes: pairs with the particles around it, state twice, sums, and the copy in a snapshot.
std::uint64_t bytesPerParticle(const Discretisation& discretisation);

/// What a boundary particle takes while the boundary is made, bytes.
inline constexpr std::uint64_t kBytesPerBoundaryParticle = 64;

}  // namespace sluice::sim
