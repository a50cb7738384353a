#pragma once

#include <string>

#include "environment.h"
#include "sluice/gl/objects.h"

namespace sluice::render {

/// The environment of the scene at hand on the device: its picture, and its ambient light. Both are kept until the
/// scene's environment or sun changes. Lives on the thread of the context.
class EnvironmentState {
 public:
  /// Throws core::InputError where the environment is a picture that cannot be read or is not twice as wide as high.
  void update(const v1::Scene& scene);

  /// For shaders/environment.glsl.
  void bind() const;

  const AmbientLight& ambient() const { return ambient_; }

 private:
  v1::Scene sceneOf_;  ///< Background and light alone.
  bool isKnown_ = false;
  gl::Texture texture_;
  AmbientLight ambient_;
};

}  // namespace sluice::render
