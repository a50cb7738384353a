#include "sluice/gl/debug_messages.h"

#include <epoxy/gl.h>

#include <string_view>
#include <utility>

namespace sluice::gl {

namespace {

void GLAPIENTRY report(GLenum /*source*/, GLenum type, GLuint /*id*/, GLenum severity, GLsizei length,
                       const GLchar* message, const void* user) {
  if (severity == GL_DEBUG_SEVERITY_NOTIFICATION) return;
  if (type == GL_DEBUG_TYPE_PERFORMANCE || type == GL_DEBUG_TYPE_OTHER) return;
  // GL hands the pointer back as it was given, without the const.
  auto* messages = static_cast<DebugMessages*>(const_cast<void*>(user));
  messages->add(std::string(message, static_cast<std::size_t>(length)));
}

}  // namespace

DebugMessages::DebugMessages() {
  glEnable(GL_DEBUG_OUTPUT);
  glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  glDebugMessageCallback(report, this);
}

DebugMessages::~DebugMessages() {
  glDebugMessageCallback(nullptr, nullptr);
  glDisable(GL_DEBUG_OUTPUT);
}

std::vector<std::string> DebugMessages::take() { return std::exchange(messages_, {}); }

}  // namespace sluice::gl
