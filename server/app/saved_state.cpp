#include "sluice/app/saved_state.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string_view>

#include <google/protobuf/text_format.h>
#include <zlib.h>

#include "sluice/core/check.h"
#include "sluice/core/input_error.h"
#include "sluice/core/state_stream.h"
#include "sluice/core/whole_file.h"
#include "sluice/scene/scene.h"

namespace sluice::app {

namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::string_view kMagic = "SLUICEST";
constexpr std::uint32_t kVersion = 2;
constexpr std::size_t kHeadSize = 8 + sizeof(std::uint32_t) + sizeof(std::uint64_t);
constexpr std::size_t kChecksumSize = sizeof(std::uint32_t);

std::uint32_t checksumOf(Bytes bytes) { return static_cast<std::uint32_t>(crc32_z(0, bytes.data(), bytes.size())); }

template <class Number>
Number numberAt(Bytes bytes, std::size_t offset) {
  Number number;
  std::memcpy(&number, bytes.data() + offset, sizeof number);
  return number;
}

/// What stands between head and checksum, both of which are right.
Bytes checkedContent(Bytes bytes, const std::string& name) {
  const std::size_t signature = std::min(bytes.size(), kMagic.size());
  if (signature == 0 || std::memcmp(bytes.data(), kMagic.data(), signature) != 0) {
    throw core::InputError(name, "", "is no saved state: it does not begin with \"" + std::string(kMagic) + "\"");
  }
  const auto cutOff = [&](std::uint64_t needed) {
    return core::InputError(
        name, "",
        "the state is cut off: it needs " + std::to_string(needed) + " bytes and has " + std::to_string(bytes.size()));
  };
  if (bytes.size() < kHeadSize + kChecksumSize) throw cutOff(kHeadSize + kChecksumSize);
  // Before the checksum: where a newer version keeps it is not known here.
  const auto version = numberAt<std::uint32_t>(bytes, kMagic.size());
  if (version > kVersion) {
    throw core::InputError(name, "",
                           "the state has version " + std::to_string(version) + "; this program reads version " +
                               std::to_string(kVersion));
  }
  const auto length = numberAt<std::uint64_t>(bytes, kMagic.size() + sizeof version);
  const std::size_t present = bytes.size() - kHeadSize - kChecksumSize;
  if (length > present) throw cutOff(kHeadSize + kChecksumSize + length);
  const std::size_t end = bytes.size() - kChecksumSize;
  if (length < present || version == 0 || checksumOf(bytes.first(end)) != numberAt<std::uint32_t>(bytes, end)) {
    throw core::InputError(name, "", "the state is damaged: its checksum does not match");
  }
  if (version < kVersion) {
    throw core::InputError(name, "",
                           "the state has version " + std::to_string(version) +
                               ", of an older program; this one reads " + "version " + std::to_string(kVersion) +
                               " alone");
  }
  return bytes.subspan(kHeadSize, length);
}

std::string textOf(const v1::Scene& scene) {
  std::string text;
  SLUICE_CHECK(google::protobuf::TextFormat::PrintToString(scene, &text));
  return text;
}

std::vector<std::uint8_t> readWhole(const std::filesystem::path& file) {
  if (std::filesystem::is_directory(file)) throw core::InputError(file.string(), "", "is a folder, no saved state");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw core::InputError(file.string(), "", "cannot be opened");
  std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(stream), {}};
  if (stream.bad()) throw core::InputError(file.string(), "", "cannot be read");
  return bytes;
}

}  // namespace

std::vector<std::uint8_t> encodeState(const v1::Scene& scene, const core::ParticleSource& source) {
  core::StateWriter content;
  content.write(std::string_view(textOf(scene)));
  source.save(content);

  std::vector<std::uint8_t> bytes(kMagic.begin(), kMagic.end());
  const auto append = [&](const auto& number) {
    const auto* raw = reinterpret_cast<const std::uint8_t*>(&number);
    bytes.insert(bytes.end(), raw, raw + sizeof number);
  };
  bytes.reserve(kHeadSize + content.bytes().size() + kChecksumSize);
  append(kVersion);
  append(std::uint64_t{content.bytes().size()});
  bytes.insert(bytes.end(), content.bytes().begin(), content.bytes().end());
  append(checksumOf(bytes));
  return bytes;
}

ResumedRun decodeState(std::span<const std::uint8_t> bytes, const std::string& name, int threads) {
  core::StateReader content(checkedContent(bytes, name), name);
  std::string text;
  content.read(text);
  ResumedRun run;
  run.live.scene = scene::parse(text, name + " (its scene)");
  run.source = openSource(run.live.scene, threads);
  run.source->resume(content);
  if (!content.atEnd()) content.fail("the state is longer than its scene allows");
  return run;
}

void saveState(const std::filesystem::path& file, const v1::Scene& scene, const core::ParticleSource& source) {
  core::writeWholeFile(file, encodeState(scene, source));
}

ResumedRun resumeState(const std::filesystem::path& file, int threads) {
  return decodeState(readWhole(file), file.string(), threads);
}

}  // namespace sluice::app
