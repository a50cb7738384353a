#pragma once

#include "sluice/particleio/mesh_file.h"

// One reader a format; what they promise stands at decodeMesh.
namespace sluice::particleio {

TriangleMesh decodeObj(std::span<const std::uint8_t> bytes, const std::string& name);
TriangleMesh decodePlyMesh(std::span<const std::uint8_t> bytes, const std::string& name);

}  // namespace sluice::particleio
