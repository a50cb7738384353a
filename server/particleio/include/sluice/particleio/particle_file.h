#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace sluice::particleio {

/// The particles of one file. Structure of arrays; every array but `positions` is either empty (the file does not have
/// it) or has one element per particle. All numbers are finite.
struct ParticleFileData {
  std::vector<Eigen::Vector3f> positions;   ///< m.
  std::vector<Eigen::Vector3f> velocities;  ///< m/s.
  std::vector<float> densities;             ///< kg/m³.
  std::vector<std::uint32_t> ids;
  std::vector<float> pressures = {};      ///< Pa.
  std::vector<std::uint8_t> fluids = {};  ///< Index of the fluid that each is of.

  std::size_t size() const { return positions.size(); }
};

enum class Format : std::uint8_t {
  Bgeo,      ///< Houdini's classic BGEO, version 5, plain or gzip inside.
  BgeoGzip,  ///< The same; written with gzip, as most programs do under either name.
  Vtk,       ///< VTK legacy file, POLYDATA or UNSTRUCTURED_GRID, binary or ASCII.
  Ply,       ///< Stanford PLY, binary of either byte order or ASCII.
  Xyz,       ///< Text, x y z on a line; further columns are ignored.
  Csv,       ///< Text with columns named in a header; without one, the first three are x, y, z.
};

/// The format that a file name's ending stands for, in any case of letters; none for any other ending.
std::optional<Format> formatOf(const std::string& fileName);

/// The endings that `formatOf` knows: ".bgeo, .bgeo.gz, .vtk, .ply, .xyz, .csv".
std::string knownEndings();

// The functions below are thread-safe. Velocities are taken from attributes named v, vel or velocity, densities from
// density or rho, ids from id or pid, pressures from pressure, fluids from fluid, whatever the case of the letters;
// other attributes are skipped. Ids that are not whole numbers from 0 to 2³²-1, fluids that are not from 0 to 255 and
// pressures that are not finite are left out.

/// Particles from the bytes of a file; `name` is for messages alone. Takes memory in proportion to the bytes that are
/// there (1 GiB at most for gzip), whatever counts they claim. Throws core::InputError with the byte or line where the
/// file is cut off, is malformed, or has a position, velocity or density that is not finite.
ParticleFileData decode(std::span<const std::uint8_t> bytes, Format format, const std::string& name);

/// The bytes of a file that `decode` reads back as the same particles. Xyz keeps the positions alone.
std::vector<std::uint8_t> encode(const ParticleFileData& particles, Format format);

/// Reads a file in the format that its name stands for. Throws core::InputError, also where there is no such file.
ParticleFileData readParticleFile(const std::filesystem::path& file);

/// Writes a file in the format that its name stands for, or in the one given; the file appears under its name only once
/// it is whole. Throws core::InputError for a name of no known format and where the file cannot be written.
void writeParticleFile(const std::filesystem::path& file, const ParticleFileData& particles);
void writeParticleFile(const std::filesystem::path& file, const ParticleFileData& particles, Format format);

}  // namespace sluice::particleio
