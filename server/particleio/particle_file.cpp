#include "sluice/particleio/particle_file.h"

#include <array>
#include <cctype>
#include <string_view>
#include <utility>

#include "codecs.h"
#include "gzip.h"
#include "read_bytes.h"
#include "sluice/core/check.h"
#include "sluice/core/input_error.h"
#include "sluice/core/whole_file.h"

namespace sluice::particleio {

namespace {

namespace fs = std::filesystem;

constexpr auto kEndings = std::to_array<std::pair<std::string_view, Format>>({{".bgeo", Format::Bgeo},
                                                                              {".bgeo.gz", Format::BgeoGzip},
                                                                              {".vtk", Format::Vtk},
                                                                              {".ply", Format::Ply},
                                                                              {".xyz", Format::Xyz},
                                                                              {".csv", Format::Csv}});

Format requiredFormat(const fs::path& file) {
  if (const std::optional<Format> format = formatOf(file.string())) return *format;
  throw core::InputError(file.string(), "", "is no particle file by its name; known endings are " + knownEndings());
}

}  // namespace

std::optional<Format> formatOf(const std::string& fileName) {
  std::string lower = fileName;
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const auto& [ending, format] : kEndings) {
    if (lower.ends_with(ending)) return format;
  }
  return std::nullopt;
}

std::string knownEndings() {
  std::string text;
  for (const auto& [ending, format] : kEndings) {
    if (!text.empty()) text += ", ";
    text += ending;
  }
  return text;
}

ParticleFileData decode(std::span<const std::uint8_t> bytes, Format format, const std::string& name) {
  switch (format) {
    case Format::Bgeo:
    case Format::BgeoGzip:
      return decodeBgeo(bytes, name);
    case Format::Vtk:
      return decodeVtk(bytes, name);
    case Format::Ply:
      return decodePly(bytes, name);
    case Format::Xyz:
    case Format::Csv:
      return decodeText(bytes, name);
  }
  SLUICE_CHECK(!"every format is decoded");
}

std::vector<std::uint8_t> encode(const ParticleFileData& particles, Format format) {
  const std::size_t count = particles.size();
  SLUICE_CHECK(particles.velocities.empty() || particles.velocities.size() == count);
  SLUICE_CHECK(particles.densities.empty() || particles.densities.size() == count);
  SLUICE_CHECK(particles.ids.empty() || particles.ids.size() == count);
  SLUICE_CHECK(particles.pressures.empty() || particles.pressures.size() == count);
  SLUICE_CHECK(particles.fluids.empty() || particles.fluids.size() == count);
  switch (format) {
    case Format::Bgeo:
      return encodeBgeo(particles);
    case Format::BgeoGzip:
      return gzip(encodeBgeo(particles));
    case Format::Vtk:
      return encodeVtk(particles);
    case Format::Ply:
      return encodePly(particles);
    case Format::Xyz:
      return encodeXyz(particles);
    case Format::Csv:
      return encodeCsv(particles);
  }
  SLUICE_CHECK(!"every format is encoded");
}

ParticleFileData readParticleFile(const fs::path& file) {
  const Format format = requiredFormat(file);
  return decode(readBytes(file), format, file.string());
}

void writeParticleFile(const fs::path& file, const ParticleFileData& particles) {
  writeParticleFile(file, particles, requiredFormat(file));
}

void writeParticleFile(const fs::path& file, const ParticleFileData& particles, Format format) {
  core::writeWholeFile(file, encode(particles, format));
}

}  // namespace sluice::particleio
