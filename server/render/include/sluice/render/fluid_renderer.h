#pragma once

#include <memory>
#include <vector>

#include "sluice/core/camera.h"
#include "sluice/core/frame.h"
#include "sluice/core/particle_snapshot.h"
#include "sluice/core/plan.h"
#include "sluice/gl/context.h"
#include "sluice/render/frame_plan.h"
#include "sluice/v1/scene.pb.h"

namespace sluice::render {

/// One value per pixel, row by row from the top.
struct FloatPicture {
  core::ImageSize size;
  std::vector<float> values;
};

/// Linear light, before tone mapping: red, green, blue, and a fourth value without meaning; row by row from the top.
struct RadiancePicture {
  core::ImageSize size;
  std::vector<float> values;  ///< 4·width·height.
};

/// Draws particles as liquid. Lives on the thread of its context. Buffers are kept between frames of equal plans.
class FluidRenderer {
 public:
  /// `context` must outlive the renderer.
  explicit FluidRenderer(gl::Context& context);
  /// As if the context's device were such a one: for tests and studies of the other kind's passes.
  FluidRenderer(gl::Context& context, const DeviceTraits& device);
  ~FluidRenderer();
  FluidRenderer(const FluidRenderer&) = delete;
  FluidRenderer& operator=(const FluidRenderer&) = delete;

  /// Plans and draws one picture of a complete, valid scene. The frame's tag carries the time of every pass and of the
  /// read-back; the caller fills in the rest of it.
  core::Frame render(const core::ParticleSnapshot& particles, const v1::Scene& scene, const core::Camera& camera,
                     core::ImageSize size);

  /// Takes note of particles that no picture shows, for what depends on how they have moved: of the moments before the
  /// first picture, or between pictures far apart.
  void follow(const core::ParticleSnapshot& particles, const v1::Scene& scene);

  /// A buffer of the last frame, for studies and tests: Resource::Surface (inverse eye depth, 1/m, after smoothing) or
  /// Resource::Thickness (m), Resource::Noise (m) or Resource::Violence (0 to 1), of one liquid. Empty when the frame
  /// did without it.
  FloatPicture readBuffer(Resource resource, std::size_t liquid = 0);

  /// The last picture.
  RadiancePicture readRadiance();

  /// What the look's smoothing makes of a given surface: inverse eye depths, 1/m, 0 where there is no liquid, seen by
  /// `camera`, with particles `spacing` m apart. The look's divisor does not count.
  FloatPicture smooth(const FloatPicture& surface, const v1::Look& look, double spacing, const core::Camera& camera);

  /// What the last frame ran and left out.
  const core::Plan& plan() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sluice::render
