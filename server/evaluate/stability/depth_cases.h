#pragma once

#include <string>
#include <vector>

#include "sluice/core/camera.h"
#include "sluice/render/fluid_renderer.h"

namespace sluice::evaluate {

/// A picture of inverse depths that is hard on a smoothing method.
struct DepthCase {
  std::string name;
  render::FloatPicture surface;
};

/// Of 128×128 pixels as `depthCaseCamera` sees them, with particles kDepthCaseSpacing apart.
std::vector<DepthCase> depthCases();
core::Camera depthCaseCamera();
constexpr double kDepthCaseSpacing = 0.1;  ///< m; 5 pixels wide at the cases' usual depth of 4 m

/// A level surface 4 m away, each pixel moved at random by up to `amplitude` of its depth.
render::FloatPicture noisyLevel(core::ImageSize size, double amplitude);

}  // namespace sluice::evaluate
