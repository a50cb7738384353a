#pragma once

#include <cstdint>
#include <string>

#include "sluice/core/camera.h"
#include "sluice/core/particle_snapshot.h"
#include "sluice/render/fluid_renderer.h"
#include "sluice/v1/scene.pb.h"

namespace sluice::evaluate {

/// A picture to draw.
struct Setting {
  v1::Scene scene;
  core::Camera camera;
  core::ImageSize size;
};

/// How far the camera turns from frame to frame, degrees: so that nothing is kept that a moving camera would not allow,
/// and so that flicker shows.
constexpr double kTurnDegrees = 0.1;

/// Timed frames, after one that warms up.
constexpr int kTimedFrames = 5;

/// A surface as it was drawn, and how long that took.
struct MeasuredSurface {
  render::FloatPicture q;        ///< Inverse eye depth, 1/m, from the setting's camera.
  render::FloatPicture turnedQ;  ///< From the camera turned by kTurnDegrees.
  double stageMilliseconds = 0;  ///< Median of the stage.
  double frameMilliseconds = 0;  ///< Median of the whole frame with its read-back.
  std::int64_t sweeps = 0;       ///< Times that the stage goes over the whole picture.
};

/// Milliseconds that one stage took in a frame; 0 where it did not run.
double stageMilliseconds(const core::Frame& frame, const std::string& stage);

/// The same of a stage's passes over its picture; 0 where it is not in the plan.
std::int64_t stageSweeps(const core::Plan& plan, const std::string& stage);

/// Draws the setting to and fro between its camera and the turned one, and keeps both surfaces.
MeasuredSurface measureSurface(render::FluidRenderer& renderer, const core::ParticleSnapshot& particles,
                               const Setting& setting, const std::string& stage);

/// Whole frames with a camera that keeps turning; the median and the stage's.
struct MeasuredFrames {
  double frameMilliseconds = 0;
  double stageMilliseconds = 0;
  std::int64_t sweeps = 0;
};
MeasuredFrames measureFrames(render::FluidRenderer& renderer, const core::ParticleSnapshot& particles, Setting setting,
                             const std::string& stage, int frames);

}  // namespace sluice::evaluate
