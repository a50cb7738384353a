#pragma once

#include <memory>
#include <string>

namespace sluice::gl {

/// An OpenGL 4.5 core context on EGL without any display: the device platform where there is a GPU, else Mesa's
/// surfaceless platform. Made, used and destroyed on one thread, where it is current for all its life.
class Context {
 public:
  /// Throws core::EnvironmentError that says what EGL lacks.
  static std::unique_ptr<Context> create();

  virtual ~Context() = default;

  /// GL_RENDERER, such as "llvmpipe (LLVM 15.0.6, 256 bits)".
  virtual const std::string& rendererName() const = 0;

  /// Rasterised by the CPU: variants are chosen by this.
  virtual bool isSoftware() const = 0;
};

}  // namespace sluice::gl
