#include "sluice/app/command_log.h"

#include <algorithm>
#include <numeric>
#include <string>

#include <google/protobuf/io/zero_copy_stream_impl.h>
#include <google/protobuf/util/delimited_message_util.h>
#include <zlib.h>

#include "sluice/app/version.h"
#include "sluice/core/input_error.h"

namespace sluice::app {

namespace {

constexpr std::uint32_t kLogVersion = 1;

void set(v1::CommandLogEntry& entry, const v1::Control& control) { *entry.mutable_control() = control; }
void set(v1::CommandLogEntry& entry, const v1::UpdateScene& update) { *entry.mutable_update_scene() = update; }
void set(v1::CommandLogEntry& entry, const v1::LoadScene& load) { *entry.mutable_load_scene() = load; }
void set(v1::CommandLogEntry& entry, const v1::Interact& interact) { *entry.mutable_interact() = interact; }

std::optional<SceneCommand> commandOf(const v1::CommandLogEntry& entry) {
  switch (entry.command_case()) {
    case v1::CommandLogEntry::kControl:
      return entry.control();
    case v1::CommandLogEntry::kUpdateScene:
      return entry.update_scene();
    case v1::CommandLogEntry::kLoadScene:
      return entry.load_scene();
    case v1::CommandLogEntry::kInteract:
      return entry.interact();
    default:
      return std::nullopt;
  }
}

}  // namespace

CommandLog::CommandLog(const std::filesystem::path& file, const v1::Scene& scene)
    : file_(file), stream_(file, std::ios::binary | std::ios::trunc) {
  v1::CommandLogHeader header;
  header.set_version(kLogVersion);
  header.set_server_version(kVersion);
  *header.mutable_scene() = scene;
  write(header);
}

void CommandLog::append(std::uint64_t afterSteps, const SceneCommand& command) {
  v1::CommandLogEntry entry;
  entry.set_after_steps(afterSteps);
  std::visit([&](const auto& c) { set(entry, c); }, command);
  write(entry);
}

void CommandLog::finish(std::uint64_t afterSteps, const core::ParticleSnapshot& particles) {
  v1::CommandLogEntry entry;
  entry.set_after_steps(afterSteps);
  entry.mutable_end()->set_particles_crc32(checksumOf(particles));
  write(entry);
}

void CommandLog::write(const google::protobuf::MessageLite& message) {
  google::protobuf::util::SerializeDelimitedToOstream(message, &stream_);
  stream_.flush();
  if (!stream_) throw core::InputError(file_.string(), "", "the log of commands cannot be written");
}

RecordedRun readCommandLog(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw core::InputError(file.string(), "", "cannot be read");
  google::protobuf::io::IstreamInputStream in(&stream);
  RecordedRun run;
  bool clean = false;
  if (!google::protobuf::util::ParseDelimitedFromZeroCopyStream(&run.header, &in, &clean) || !run.header.has_scene()) {
    throw core::InputError(file.string(), "", "is no log of commands");
  }
  if (run.header.version() > kLogVersion) {
    throw core::InputError(file.string(), "",
                           "the log has version " + std::to_string(run.header.version()) +
                               "; this program reads up to version " + std::to_string(kLogVersion));
  }
  v1::CommandLogEntry entry;
  while (google::protobuf::util::ParseDelimitedFromZeroCopyStream(&entry, &in, &clean)) {
    run.entries.push_back(entry);
    entry.Clear();
  }
  return run;
}

std::uint32_t checksumOf(const core::ParticleSnapshot& particles) {
  std::vector<std::uint32_t> order(particles.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return particles.ids[a] < particles.ids[b]; });
  uLong sum = crc32(0, nullptr, 0);
  const auto add = [&](const Eigen::Vector3f& v) {
    sum = crc32_z(sum, reinterpret_cast<const Bytef*>(v.data()), 3 * sizeof(float));
  };
  for (const std::uint32_t i : order) {
    add(particles.positions[i]);
    add(particles.velocities[i]);
  }
  return static_cast<std::uint32_t>(sum);
}

Replay replay(const RecordedRun& recorded, int threads) {
  LiveScene live;
  live.scene = recorded.header.scene();
  // What viewers were allowed when it was recorded has been decided then.
  Replay result{std::make_unique<SceneRun>(std::move(live), threads, 0), 0, {}};
  SceneRun& run = *result.run;
  for (const v1::CommandLogEntry& entry : recorded.entries) {
    while (run.steps() < entry.after_steps()) {
      const bool more = run.advance();
      ++result.steps;
      // A step that failed counts as one too, so what follows an end follows it here.
      if (!more && run.steps() < entry.after_steps()) {
        throw core::InputError("", "after_steps",
                               "the run ends after " + std::to_string(run.steps()) +
                                   " steps; the log has a command after " + std::to_string(entry.after_steps()));
      }
    }
    if (entry.has_end()) {
      result.same = checksumOf(*run.source().snapshot()) == entry.end().particles_crc32();
      break;
    }
    const std::uint64_t before = run.steps();
    if (const auto command = commandOf(entry)) run.apply(*command);
    if (run.steps() > before) ++result.steps;
  }
  return result;
}

}  // namespace sluice::app
