#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <vector>

#include "sluice/app/scene_run.h"
#include "sluice/core/particle_snapshot.h"
#include "sluice/v1/command_log.pb.h"

namespace sluice::app {

/// Writes what changes a run to a file, from which `replay` makes the same run again. Every entry is on disk when
/// `append` returns, so a log is of use however the program ends. For one thread.
class CommandLog {
 public:
  /// Throws core::InputError where the file cannot be written.
  CommandLog(const std::filesystem::path& file, const v1::Scene& scene);

  void append(std::uint64_t afterSteps, const SceneCommand& command);

  /// The run has come so far and the log ends.
  void finish(std::uint64_t afterSteps, const core::ParticleSnapshot& particles);

 private:
  void write(const google::protobuf::MessageLite& message);

  std::filesystem::path file_;
  std::ofstream stream_;
};

struct RecordedRun {
  v1::CommandLogHeader header;
  std::vector<v1::CommandLogEntry> entries;
};

/// Throws core::InputError for a file that is no log or of a newer version. What is cut off at its end, as by a power
/// cut, is left out.
RecordedRun readCommandLog(const std::filesystem::path& file);

/// CRC-32 of the particles' positions and velocities in the order of their ids.
std::uint32_t checksumOf(const core::ParticleSnapshot& particles);

struct Replay {
  std::unique_ptr<SceneRun> run;  ///< At the end of the log.
  std::uint64_t steps = 0;        ///< In all.
  /// Whether the particles are those of the recorded run; none where its log has no end.
  std::optional<bool> same;
};

/// Makes the recorded run again. Throws core::InputError where an entry cannot be followed.
Replay replay(const RecordedRun& recorded, int threads);

}  // namespace sluice::app
