#pragma once

#include <memory>
#include <string>

namespace sluice::gl {

/// Whether the driver is asked to report errors and undefined behaviour (see DebugMessages); costs a little time.
enum class DebugOutput { Off, On };

/// An OpenGL 4.5 core context on EGL without any display: the device platform where there is a GPU, else Mesa's
/// surfaceless platform. Made, used and destroyed on one thread, where it is current for all its life.
class Context {
 public:
  /// Throws core::EnvironmentError that says what EGL lacks.
  static std::unique_ptr<Context> create(DebugOutput debug = DebugOutput::Off);

  virtual ~Context() = default;

  /// GL_RENDERER, such as "llvmpipe (LLVM 15.0.6, 256 bits)".
  virtual const std::string& rendererName() const = 0;

  /// Rasterised by the CPU: variants are chosen by this.
  virtual bool isSoftware() const = 0;
};

}  // namespace sluice::gl
