#include "sluice/particleio/mesh_file.h"

#include <cctype>

#include "mesh_codecs.h"
#include "read_bytes.h"
#include "sluice/core/check.h"
#include "sluice/core/input_error.h"

namespace sluice::particleio {

std::optional<MeshFormat> meshFormatOf(const std::string& fileName) {
  std::string lower = fileName;
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (lower.ends_with(".obj")) return MeshFormat::Obj;
  if (lower.ends_with(".ply")) return MeshFormat::Ply;
  return std::nullopt;
}

TriangleMesh decodeMesh(std::span<const std::uint8_t> bytes, MeshFormat format, const std::string& name) {
  switch (format) {
    case MeshFormat::Obj:
      return decodeObj(bytes, name);
    case MeshFormat::Ply:
      return decodePlyMesh(bytes, name);
  }
  SLUICE_CHECK(!"every format is decoded");
}

TriangleMesh readMeshFile(const std::filesystem::path& file) {
  const std::optional<MeshFormat> format = meshFormatOf(file.string());
  if (!format) throw core::InputError(file.string(), "", "is no mesh by its name; known endings are .obj, .ply");
  return decodeMesh(readBytes(file), *format, file.string());
}

}  // namespace sluice::particleio
