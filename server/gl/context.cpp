#include "sluice/gl/context.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <array>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sluice/core/input_error.h"

namespace sluice::gl {

namespace {

using core::EnvironmentError;

std::string_view eglErrorName(EGLint error) {
  switch (error) {
    case EGL_SUCCESS:
      return "no error given";
    case EGL_NOT_INITIALIZED:
      return "EGL_NOT_INITIALIZED";
    case EGL_BAD_ACCESS:
      return "EGL_BAD_ACCESS";
    case EGL_BAD_ALLOC:
      return "EGL_BAD_ALLOC";
    case EGL_BAD_ATTRIBUTE:
      return "EGL_BAD_ATTRIBUTE";
    case EGL_BAD_CONFIG:
      return "EGL_BAD_CONFIG";
    case EGL_BAD_DISPLAY:
      return "EGL_BAD_DISPLAY";
    case EGL_BAD_MATCH:
      return "EGL_BAD_MATCH";
    case EGL_BAD_PARAMETER:
      return "EGL_BAD_PARAMETER";
    default:
      return "an unknown error";
  }
}

std::string joined(std::initializer_list<std::string_view> parts) {
  std::string text;
  for (const std::string_view part : parts) text += part;
  return text;
}

bool hasExtension(std::string_view list, std::string_view name) {
  for (std::size_t at = list.find(name); at != std::string_view::npos; at = list.find(name, at + 1)) {
    const std::size_t end = at + name.size();
    if ((at == 0 || list[at - 1] == ' ') && (end == list.size() || list[end] == ' ')) return true;
  }
  return false;
}

std::string_view queryString(EGLDisplay display, EGLint name) {
  const char* text = eglQueryString(display, name);
  return text == nullptr ? std::string_view{} : std::string_view(text);
}

/// Owns an initialised display and the context made on it.
class EglSession {
 public:
  EglSession() = default;
  EglSession(EglSession&& other) noexcept
      : display_(std::exchange(other.display_, EGL_NO_DISPLAY)),
        context_(std::exchange(other.context_, EGL_NO_CONTEXT)) {}
  EglSession& operator=(EglSession&& other) noexcept {
    std::swap(display_, other.display_);
    std::swap(context_, other.context_);
    return *this;
  }
  ~EglSession() {
    if (display_ == EGL_NO_DISPLAY) return;
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context_ != EGL_NO_CONTEXT) eglDestroyContext(display_, context_);
    eglTerminate(display_);
  }

  /// Makes a GL 4.5 core context current on `display`; a failure says which call refused it.
  static EglSession open(EGLDisplay display, DebugOutput debug, std::string_view platform) {
    const auto fail = [&](std::string_view call) {
      return EnvironmentError(joined({"EGL, ", platform, ": ", call, " failed (", eglErrorName(eglGetError()), ")"}));
    };
    if (display == EGL_NO_DISPLAY) throw fail("eglGetPlatformDisplayEXT");
    if (eglInitialize(display, nullptr, nullptr) == EGL_FALSE) throw fail("eglInitialize");
    EglSession session;
    session.display_ = display;

    const std::string_view extensions = queryString(display, EGL_EXTENSIONS);
    for (const std::string_view needed :
         {"EGL_KHR_surfaceless_context", "EGL_KHR_no_config_context", "EGL_KHR_create_context"}) {
      if (!hasExtension(extensions, needed)) {
        throw EnvironmentError(joined({"EGL, ", platform, ": ", needed, " is missing"}));
      }
    }
    if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) throw fail("eglBindAPI(EGL_OPENGL_API)");
    const std::array<EGLint, 9> attributes{EGL_CONTEXT_MAJOR_VERSION,
                                           4,
                                           EGL_CONTEXT_MINOR_VERSION,
                                           5,
                                           EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                           EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                           EGL_CONTEXT_OPENGL_DEBUG,
                                           debug == DebugOutput::On ? EGL_TRUE : EGL_FALSE,
                                           EGL_NONE};
    session.context_ = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
    if (session.context_ == EGL_NO_CONTEXT) throw fail("eglCreateContext for OpenGL 4.5 core");
    if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, session.context_) == EGL_FALSE) {
      throw fail("eglMakeCurrent");
    }
    return session;
  }

 private:
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

/// EGL devices that are graphics hardware.
std::vector<EGLDeviceEXT> hardwareDevices() {
  EGLint count = 0;
  if (eglQueryDevicesEXT(0, nullptr, &count) == EGL_FALSE || count <= 0) return {};
  std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
  if (eglQueryDevicesEXT(count, devices.data(), &count) == EGL_FALSE) return {};
  devices.resize(static_cast<std::size_t>(count));
  std::erase_if(devices, [](EGLDeviceEXT device) {
    const char* extensions = eglQueryDeviceStringEXT(device, EGL_EXTENSIONS);
    return extensions != nullptr && hasExtension(extensions, "EGL_MESA_device_software");
  });
  return devices;
}

EglSession openBest(DebugOutput debug) {
  const std::string_view client = queryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  if (client.empty()) throw EnvironmentError("EGL: no driver offers client extensions (is libegl-mesa0 installed?)");
  if (!hasExtension(client, "EGL_EXT_platform_base")) throw EnvironmentError("EGL: EGL_EXT_platform_base is missing");

  std::string problems;
  const auto attempt = [&](EGLenum platform, void* device, std::string_view name, EglSession& session) {
    try {
      session = EglSession::open(eglGetPlatformDisplayEXT(platform, device, nullptr), debug, name);
      return true;
    } catch (const EnvironmentError& error) {
      problems += problems.empty() ? error.what() : std::string("; ") + error.what();
      return false;
    }
  };

  EglSession session;
  if (hasExtension(client, "EGL_EXT_platform_device") && hasExtension(client, "EGL_EXT_device_enumeration")) {
    for (EGLDeviceEXT device : hardwareDevices()) {
      if (attempt(EGL_PLATFORM_DEVICE_EXT, device, "device platform", session)) return session;
    }
  }
  if (hasExtension(client, "EGL_MESA_platform_surfaceless") &&
      attempt(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, "surfaceless platform", session)) {
    return session;
  }
  throw EnvironmentError(
      problems.empty() ? "EGL: neither a GPU on EGL_EXT_platform_device nor EGL_MESA_platform_surfaceless is there"
                       : problems);
}

class EglContext final : public Context {
 public:
  explicit EglContext(EglSession session) : session_(std::move(session)) {
    const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    rendererName_ = name == nullptr ? "unknown" : name;
    for (const std::string_view software : {"llvmpipe", "softpipe", "swrast", "SwiftShader"}) {
      software_ = software_ || rendererName_.find(software) != std::string::npos;
    }
  }

  const std::string& rendererName() const override { return rendererName_; }
  bool isSoftware() const override { return software_; }

 private:
  EglSession session_;
  std::string rendererName_;
  bool software_ = false;
};

}  // namespace

std::unique_ptr<Context> Context::create(DebugOutput debug) { return std::make_unique<EglContext>(openBest(debug)); }

}  // namespace sluice::gl
