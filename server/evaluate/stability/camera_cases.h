#pragma once

#include <string>
#include <vector>

#include "sluice/core/camera.h"
#include "sluice/core/particle_snapshot.h"

namespace sluice::evaluate {

/// Particles and a camera that stands badly for them.
struct CameraCase {
  std::string name;
  core::ParticleSnapshot particles;
  core::Camera camera;
  core::ImageSize size;
};

std::vector<CameraCase> cameraCases();

}  // namespace sluice::evaluate
