#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "sluice/gl/objects.h"

namespace sluice::gl {

/// The text of one shader file. Both views must outlive the library.
struct ShaderSource {
  std::string_view name;
  std::string_view text;
};

/// A shader that does not compile or link. The message names file and line.
class ShaderError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A source with its includes put in, each file once, and where each of its lines comes from.
struct ExpandedShader {
  struct Place {
    std::string file;
    int line = 0;
  };

  std::string text;
  std::vector<Place> places;  ///< One per line of `text`.
};

/// Shader files by name, which may `#include "other.glsl"` each other. A file starts right after the #version line,
/// which the library writes, followed by one `#define NAME 1` for every flag of a variant.
class ShaderLibrary {
 public:
  explicit ShaderLibrary(std::vector<ShaderSource> sources) : sources_(std::move(sources)) {}

  /// Throws ShaderError for a name that is not there.
  ExpandedShader expand(std::string_view name, std::span<const std::string_view> defines) const;

  /// Compiles and links. Throws ShaderError.
  Program program(std::string_view vertexName, std::string_view fragmentName,
                  std::span<const std::string_view> defines = {}) const;

  /// The same of a compute shader.
  Program computeProgram(std::string_view name, std::span<const std::string_view> defines = {}) const;

 private:
  std::string_view find(std::string_view name) const;
  void append(std::string_view name, ExpandedShader& expanded, std::vector<std::string_view>& included) const;
  Shader compile(GLenum stage, std::string_view name, std::span<const std::string_view> defines) const;

  std::vector<ShaderSource> sources_;
};

/// Puts files and their own line numbers into a compiler's log about `shader`: "0:31(3): error" (Mesa) and
/// "0(31) : error" (NVIDIA) become "floor.glsl:7: (3): error" and "floor.glsl:7:  : error". The text carries no #line
/// directives, because Mesa loses their file numbers inside expressions.
std::string namePlaces(std::string_view log, const ExpandedShader& shader);

}  // namespace sluice::gl
