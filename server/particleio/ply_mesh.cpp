// Triangles in a PLY file: the elements "vertex" and "face", in either order.

#include <algorithm>
#include <cmath>

#include "mesh_codecs.h"
#include "ply_reader.h"

namespace sluice::particleio {

namespace {

constexpr std::array<std::string_view, 6> kVertexNames{"x", "y", "z", "nx", "ny", "nz"};

class PlyMeshReader {
 public:
  PlyMeshReader(std::span<const std::uint8_t> bytes, const std::string& name) : reader_(bytes, name) {}

  TriangleMesh read() && {
    bool hasVertices = false;
    for (const PlyElement& element : reader_.elements()) {
      if (element.name == "vertex") {
        readVertices(element);
        hasVertices = true;
      } else if (element.name == "face") {
        readFaces(element);
      } else {
        reader_.skip(element);
      }
    }
    if (!hasVertices) throw core::InputError(reader_.fileName(), "", "has no element \"vertex\"");
    if (mesh_.triangles.empty()) throw core::InputError(reader_.fileName(), "", "has no faces");
    // Faces may stand before the vertices, so that their indices are checked last.
    if (largestIndex_ >= mesh_.positions.size()) {
      throw core::InputError(reader_.fileName(), "",
                             "a face names vertex " + std::to_string(largestIndex_) + "; there are " +
                                 std::to_string(mesh_.positions.size()));
    }
    return std::move(mesh_);
  }

 private:
  void readVertices(const PlyElement& element) {
    std::vector<std::size_t> places;  // of each property in kVertexNames; its size for others
    std::array<bool, kVertexNames.size()> given{};
    for (const PlyProperty& property : element.properties) {
      const auto* const found = std::ranges::find(kVertexNames, property.name);
      const bool known = !property.countType && found != kVertexNames.end();
      places.push_back(known ? static_cast<std::size_t>(found - kVertexNames.begin()) : kVertexNames.size());
      if (known) given[places.back()] = true;
    }
    if (!given[0] || !given[1] || !given[2]) reader_.fail("the element \"vertex\" lacks one of x, y, z");
    const bool normals = given[3] && given[4] && given[5];
    reader_.checkSize(element);

    mesh_.positions.resize(element.count);
    mesh_.normals.resize(normals ? element.count : 0);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      std::array<float, kVertexNames.size()> values{};
      for (std::size_t p = 0; p < places.size(); ++p) {
        if (places[p] == kVertexNames.size()) {
          reader_.skip(element.properties[p]);
          continue;
        }
        const auto value = static_cast<float>(reader_.number(element.properties[p].type));
        if (!std::isfinite(value)) {
          reader_.fail(element.properties[p].name + " of vertex " + std::to_string(i) + " is not finite");
        }
        values[places[p]] = value;
      }
      mesh_.positions[i] = {values[0], values[1], values[2]};
      if (normals) mesh_.normals[i] = Eigen::Vector3f(values[3], values[4], values[5]).stableNormalized();
    }
  }

  void readFaces(const PlyElement& element) {
    const auto isCorners = [](const PlyProperty& p) {
      return p.countType && (p.name == "vertex_indices" || p.name == "vertex_index");
    };
    if (std::ranges::count_if(element.properties, isCorners) != 1) {
      reader_.fail("the element \"face\" needs one list \"vertex_indices\"");
    }
    reader_.checkSize(element);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (const PlyProperty& property : element.properties) {
        isCorners(property) ? readFace(property) : reader_.skip(property);
      }
    }
  }

  void readFace(const PlyProperty& corners) {
    const std::uint64_t count = reader_.listLength(corners);
    if (count < 3) reader_.fail("a face needs three corners at the least; this one has " + std::to_string(count));
    const std::uint32_t first = index(corners.type);
    std::uint32_t last = index(corners.type);
    for (std::uint64_t i = 2; i < count; ++i) {
      const std::uint32_t next = index(corners.type);
      mesh_.triangles.push_back({first, last, next});
      last = next;
    }
  }

  std::uint32_t index(PlyType type) {
    const double value = reader_.number(type);
    if (!(value >= 0 && value <= 4294967295.0) || value != std::floor(value)) {
      reader_.fail("a corner of a face is not a number of a vertex");
    }
    largestIndex_ = std::max(largestIndex_, static_cast<std::uint32_t>(value));
    return static_cast<std::uint32_t>(value);
  }

  PlyReader reader_;
  TriangleMesh mesh_;
  std::uint32_t largestIndex_ = 0;
};

}  // namespace

TriangleMesh decodePlyMesh(std::span<const std::uint8_t> bytes, const std::string& name) {
  return PlyMeshReader(bytes, name).read();
}

}  // namespace sluice::particleio
