#pragma once

#include <cstdint>

namespace sluice::sim {

/// Memory that this machine can still give, bytes.
std::uint64_t availableMemory();

/// What a particle takes, bytes: pairs, state twice, sums, and the copy in a snapshot.
inline constexpr std::uint64_t kBytesPerParticle = 700;

/// What a boundary particle takes while the boundary is made, bytes.
inline constexpr std::uint64_t kBytesPerBoundaryParticle = 64;

}  // namespace sluice::sim
