#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace sluice::particleio {

/// Triangles with shared vertices. All numbers are finite, all indices valid.
struct TriangleMesh {
  std::vector<Eigen::Vector3f> positions;
  /// Empty, or one per position, of unit length; 0 where the file names a normal without a direction.
  std::vector<Eigen::Vector3f> normals;
  /// Counter-clockwise as seen from outside, if the file keeps to that.
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

enum class MeshFormat : std::uint8_t {
  Obj,  ///< Wavefront OBJ: v, vn and f; texture coordinates, groups and materials are passed over.
  Ply,  ///< Stanford PLY, binary of either byte order or ASCII, with lists "vertex_indices" or "vertex_index".
};

/// The format that a file name's ending stands for, in any case of letters; none for any other ending.
std::optional<MeshFormat> meshFormatOf(const std::string& fileName);

// Both functions are thread-safe. Polygons are cut into triangles as fans about their first corner. A position with
// several normals, as along a sharp edge, becomes several vertices. Normals are left out where a face lacks them.

/// A mesh from the bytes of a file; `name` is for messages alone. Takes memory in proportion to the bytes that are
/// there, whatever counts they claim. Throws core::InputError with the line (OBJ) or byte (PLY) where the file is cut
/// off, is malformed, names a vertex that it does not have, or has a number that is not finite; and where it has no
/// faces.
TriangleMesh decodeMesh(std::span<const std::uint8_t> bytes, MeshFormat format, const std::string& name);

/// Reads a file in the format that its name stands for. Throws core::InputError, also where there is no such file.
TriangleMesh readMeshFile(const std::filesystem::path& file);

}  // namespace sluice::particleio
