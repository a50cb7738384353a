#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "sluice/app/live_scene.h"
#include "sluice/core/particle_source.h"

namespace sluice::app {

// The state of a run as a file, with its scene, from which the run can be gone on with:
//
//   8 bytes  "SLUICEST"
//   uint32   version of all that follows
//   uint64   length of the rest
//            the scene as protobuf text, behind its length (uint64)
//            what the source has saved (ParticleSource::save)
//   uint32   CRC-32 of everything before
//
// Numbers are little-endian. A file of the same version gives the same particles, bit for bit, as the run would have
// had that it was saved in, on any machine with any number of threads.

/// The bytes of a state file. Throws core::InputError where the source has no state that can be saved.
std::vector<std::uint8_t> encodeState(const v1::Scene& scene, const core::ParticleSource& source);

/// A run that goes on from a saved state.
struct ResumedRun {
  LiveScene live;
  std::unique_ptr<core::ParticleSource> source;
};

/// Throws core::InputError where the bytes are no state, of another version, cut off or damaged; `name` is for
/// messages. `threads` 0 means one for each core.
ResumedRun decodeState(std::span<const std::uint8_t> bytes, const std::string& name, int threads);

/// The same from and to a file, which appears under its name once it is whole. Throw core::InputError, also where it
/// cannot be read or written.
void saveState(const std::filesystem::path& file, const v1::Scene& scene, const core::ParticleSource& source);
ResumedRun resumeState(const std::filesystem::path& file, int threads);

}  // namespace sluice::app
