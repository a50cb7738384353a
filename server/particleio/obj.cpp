// Wavefront OBJ: a keyword and its words on a line; # begins a comment. Indices count from 1, or, where negative, back
// from the last vertex so far.

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "mesh_codecs.h"
#include "sluice/core/input_error.h"
#include "text_numbers.h"

namespace sluice::particleio {

namespace {

constexpr std::string_view kBlank = " \t\r";

/// Takes the first word off a line; empty at its end.
std::string_view takeWord(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(kBlank), line.size()));
  const std::string_view word = line.substr(0, std::min(line.find_first_of(kBlank), line.size()));
  line.remove_prefix(word.size());
  return word;
}

/// Takes what stands before the next slash, and the slash.
std::string_view takePart(std::string_view& word) {
  const std::string_view part = word.substr(0, std::min(word.find('/'), word.size()));
  word.remove_prefix(std::min(part.size() + 1, word.size()));
  return part;
}

/// A corner of a face: indices from 0.
struct Corner {
  std::uint32_t position = 0;
  std::uint32_t normal = 0;
};

class ObjReader {
 public:
  ObjReader(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  TriangleMesh read() && {
    while (!text_.empty()) {
      ++lineNumber_;
      std::string_view line = text_.substr(0, std::min(text_.find('\n'), text_.size()));
      text_.remove_prefix(std::min(line.size() + 1, text_.size()));
      readLine(line.substr(0, std::min(line.find('#'), line.size())));
    }
    if (triangles_.empty()) throw core::InputError(name_, "", "has no faces");
    return everyCornerHasNormal_ ? withNormals() : withoutNormals();
  }

 private:
  void readLine(std::string_view line) {
    const std::string_view keyword = takeWord(line);
    if (keyword == "v") {
      positions_.push_back(vector(line, "vertex"));
    } else if (keyword == "vn") {
      const Eigen::Vector3f normal = vector(line, "normal");
      normals_.push_back(normal.stableNormalized());
    } else if (keyword == "f") {
      readFace(line);
    }
  }

  /// Three numbers; further ones are weights or colours.
  Eigen::Vector3f vector(std::string_view line, std::string_view what) const {
    Eigen::Vector3f result;
    for (float& component : result) {
      const std::string_view word = takeWord(line);
      const std::optional<double> value = parseNumber<double>(word);
      if (!value) {
        fail(word.empty() ? "a " + std::string(what) + " needs three numbers" : shown(word) + " is not a number");
      }
      component = static_cast<float>(*value);
      if (!std::isfinite(component)) fail("the " + std::string(what) + " is not finite: " + shown(word));
    }
    return result;
  }

  void readFace(std::string_view line) {
    std::size_t corners = 0;
    Corner first;
    Corner last;
    for (std::string_view word = takeWord(line); !word.empty(); word = takeWord(line)) {
      const Corner next = corner(word);
      if (corners == 0) first = next;
      if (corners >= 2) triangles_.push_back({first, last, next});
      last = next;
      ++corners;
    }
    if (corners < 3) fail("a face needs three corners at the least; this one has " + std::to_string(corners));
  }

  /// v, v/vt, v//vn or v/vt/vn.
  Corner corner(std::string_view word) {
    std::string_view rest = word;
    Corner result;
    result.position = index(takePart(rest), positions_.size(), "vertices", word);
    takePart(rest);
    if (rest.empty()) {
      everyCornerHasNormal_ = false;
    } else {
      result.normal = index(rest, normals_.size(), "normals", word);
    }
    return result;
  }

  std::uint32_t index(std::string_view text, std::size_t count, std::string_view what, std::string_view corner) const {
    const std::optional<std::int64_t> number = parseNumber<std::int64_t>(text);
    if (!number) fail(shown(corner) + " is not a corner of a face");
    const auto signedCount = static_cast<std::int64_t>(count);
    if (*number == 0 || *number > signedCount || *number < -signedCount) {
      fail("index " + std::to_string(*number) + " is outside the " + std::to_string(count) + " " + std::string(what) +
           " so far");
    }
    return static_cast<std::uint32_t>(*number > 0 ? *number - 1 : signedCount + *number);
  }

  TriangleMesh withoutNormals() {
    TriangleMesh mesh;
    mesh.positions = std::move(positions_);
    mesh.triangles.reserve(triangles_.size());
    for (const auto& [a, b, c] : triangles_) mesh.triangles.push_back({a.position, b.position, c.position});
    return mesh;
  }

  TriangleMesh withNormals() const {
    TriangleMesh mesh;
    std::unordered_map<std::uint64_t, std::uint32_t> vertexOf;
    const auto vertex = [&](const Corner& corner) {
      const std::uint64_t key = (std::uint64_t{corner.position} << 32U) | corner.normal;
      const auto [place, isNew] = vertexOf.try_emplace(key, static_cast<std::uint32_t>(mesh.positions.size()));
      if (isNew) {
        mesh.positions.push_back(positions_[corner.position]);
        mesh.normals.push_back(normals_[corner.normal]);
      }
      return place->second;
    };
    mesh.triangles.reserve(triangles_.size());
    for (const auto& [a, b, c] : triangles_) {
      const std::uint32_t va = vertex(a);
      const std::uint32_t vb = vertex(b);
      mesh.triangles.push_back({va, vb, vertex(c)});
    }
    return mesh;
  }

  [[noreturn]] void fail(const std::string& problem) const {
    throw core::InputError(name_ + ":" + std::to_string(lineNumber_), "", problem);
  }

  std::string_view text_;
  std::string name_;
  std::size_t lineNumber_ = 0;
  std::vector<Eigen::Vector3f> positions_;
  std::vector<Eigen::Vector3f> normals_;
  std::vector<std::array<Corner, 3>> triangles_;
  bool everyCornerHasNormal_ = true;
};

}  // namespace

TriangleMesh decodeObj(std::span<const std::uint8_t> bytes, const std::string& name) {
  return ObjReader({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, name).read();
}

}  // namespace sluice::particleio
