#include "sluice/gl/shader_library.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <initializer_list>

namespace sluice::gl {

namespace {

/// Calls `visit` with every line of `text`, without its line break.
template <class Visitor>
void forEachLine(std::string_view text, Visitor visit) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    visit(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

/// The file named by an `#include "name"` line, or empty.
std::string_view includedFile(std::string_view line) {
  constexpr std::string_view kDirective = "#include \"";
  if (!line.starts_with(kDirective)) return {};
  line.remove_prefix(kDirective.size());
  return line.substr(0, line.find('"'));
}

template <class GetParameter, class GetLog>
std::string infoLog(GLuint name, GetParameter getParameter, GetLog getLog) {
  GLint length = 0;
  getParameter(name, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
  GLsizei written = 0;
  getLog(name, static_cast<GLsizei>(log.size()), &written, log.data());
  log.resize(static_cast<std::size_t>(written));
  while (!log.empty() && log.back() == '\n') log.pop_back();
  return log;
}

}  // namespace

std::string namePlaces(std::string_view log, const ExpandedShader& shader) {
  std::string named;
  forEachLine(log, [&](std::string_view line) {
    if (!named.empty()) named += '\n';
    // "<source>:<line>" or "<source>(<line>)"
    const char* const end = line.data() + line.size();
    std::size_t source = 0;
    std::size_t number = 0;
    const auto [afterSource, noSource] = std::from_chars(line.data(), end, source);
    if (noSource == std::errc{} && afterSource != end && (*afterSource == ':' || *afterSource == '(')) {
      const auto [afterNumber, noNumber] = std::from_chars(afterSource + 1, end, number);
      if (noNumber == std::errc{} && number >= 1 && number <= shader.places.size()) {
        const ExpandedShader::Place& place = shader.places[number - 1];
        named += place.file + ':' + std::to_string(place.line) + ": ";
        const bool closes = *afterSource == '(' && afterNumber != end;
        line.remove_prefix(static_cast<std::size_t>(afterNumber - line.data()) + (closes ? 1 : 0));
      }
    }
    named += line;
  });
  return named;
}

namespace {

Program link(std::initializer_list<const Shader*> shaders, const std::string& name) {
  Program program(glCreateProgram());
  for (const Shader* shader : shaders) glAttachShader(program.name(), shader->name());
  glLinkProgram(program.name());
  GLint linked = GL_FALSE;
  glGetProgramiv(program.name(), GL_LINK_STATUS, &linked);
  if (linked == GL_FALSE) {
    throw ShaderError(name + ": " + infoLog(program.name(), glGetProgramiv, glGetProgramInfoLog));
  }
  return program;
}

}  // namespace

std::string_view ShaderLibrary::find(std::string_view name) const {
  const auto source = std::ranges::find(sources_, name, &ShaderSource::name);
  if (source == sources_.end()) throw ShaderError(std::string(name) + ": there is no such shader file");
  return source->text;
}

void ShaderLibrary::append(std::string_view name, ExpandedShader& expanded,
                           std::vector<std::string_view>& included) const {
  included.push_back(name);
  int line = 0;
  forEachLine(find(name), [&](std::string_view content) {
    ++line;
    const std::string_view file = includedFile(content);
    if (file.empty()) {
      expanded.text += content;
      expanded.text += '\n';
      expanded.places.push_back({std::string(name), line});
    } else if (std::ranges::find(included, file) == included.end()) {
      append(file, expanded, included);
    }
  });
}

ExpandedShader ShaderLibrary::expand(std::string_view name, std::span<const std::string_view> defines) const {
  ExpandedShader expanded;
  const auto addLine = [&](std::string line) {
    expanded.text += std::move(line) + '\n';
    expanded.places.push_back({std::string(name), 0});
  };
  addLine("#version 450 core");
  for (const std::string_view define : defines) addLine("#define " + std::string(define) + " 1");
  std::vector<std::string_view> included;
  append(name, expanded, included);
  return expanded;
}

Shader ShaderLibrary::compile(GLenum stage, std::string_view name, std::span<const std::string_view> defines) const {
  const ExpandedShader expanded = expand(name, defines);
  Shader shader(glCreateShader(stage));
  const GLchar* text = expanded.text.c_str();
  glShaderSource(shader.name(), 1, &text, nullptr);
  glCompileShader(shader.name());
  GLint compiled = GL_FALSE;
  glGetShaderiv(shader.name(), GL_COMPILE_STATUS, &compiled);
  if (compiled == GL_FALSE) {
    throw ShaderError(namePlaces(infoLog(shader.name(), glGetShaderiv, glGetShaderInfoLog), expanded));
  }
  return shader;
}

Program ShaderLibrary::program(std::string_view vertexName, std::string_view fragmentName,
                               std::span<const std::string_view> defines) const {
  const Shader vertex = compile(GL_VERTEX_SHADER, vertexName, defines);
  const Shader fragment = compile(GL_FRAGMENT_SHADER, fragmentName, defines);
  return link({&vertex, &fragment}, std::string(vertexName) + " with " + std::string(fragmentName));
}

Program ShaderLibrary::computeProgram(std::string_view name, std::span<const std::string_view> defines) const {
  const Shader shader = compile(GL_COMPUTE_SHADER, name, defines);
  return link({&shader}, std::string(name));
}

}  // namespace sluice::gl
