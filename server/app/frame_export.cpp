#include "frame_export.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <utility>

#include "sluice/core/check.h"
#include "sluice/core/input_error.h"

namespace sluice::app {

namespace {

// With gzip under the plain ending, which is how other programs write it and what all of them read.
constexpr auto kFormats = std::to_array<std::pair<const char*, particleio::Format>>({
    {"bgeo", particleio::Format::BgeoGzip},
    {"vtk", particleio::Format::Vtk},
    {"ply", particleio::Format::Ply},
    {"csv", particleio::Format::Csv},
});

particleio::Format formatNamed(const std::string& name) {
  for (const auto& [known, format] : kFormats) {
    if (name == known) return format;
  }
  SLUICE_CHECK(!"a format that formats() names");
}

particleio::ParticleFileData fileData(core::ParticleSnapshot&& snapshot) {
  return {std::move(snapshot.positions), std::move(snapshot.velocities), std::move(snapshot.densities),
          std::move(snapshot.ids),       std::move(snapshot.pressures),  std::move(snapshot.fluids)};
}

}  // namespace

const std::vector<std::string>& FrameExport::formats() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const auto& [name, format] : kFormats) all.emplace_back(name);
    return all;
  }();
  return names;
}

FrameExport::FrameExport(std::filesystem::path folder, const std::string& format, double framesPerSecond,
                         double startSeconds)
    : folder_(std::move(folder)),
      ending_("." + format),
      format_(formatNamed(format)),
      framesPerSecond_(framesPerSecond) {
  // Rounding may have brought the start's own frame to either side of it.
  next_ = static_cast<std::uint64_t>(std::max(std::floor(startSeconds * framesPerSecond) - 1, 0.0));
  while (nextSeconds() < startSeconds) ++next_;
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error) throw core::InputError(folder_.string(), "--out", "cannot be made: " + error.message());
}

void FrameExport::write(const core::ParticleSource& source) {
  std::array<char, 32> name{};
  std::snprintf(name.data(), name.size(), "frame_%04llu", static_cast<unsigned long long>(next_));
  particleio::writeParticleFile(folder_ / (name.data() + ending_), fileData(std::move(*source.snapshot())), format_);
  ++next_;
  ++written_;
}

}  // namespace sluice::app
