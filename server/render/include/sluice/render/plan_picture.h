#pragma once

#include "sluice/core/camera.h"
#include "sluice/core/particle_snapshot.h"
#include "sluice/core/plan.h"
#include "sluice/v1/scene.pb.h"

namespace sluice::render {

/// What a renderer that has drawn nothing yet would run for this picture, and leave out, without any GL.
/// `maxPointPixels` is the largest point of the device; 255 is that of Mesa's software renderer. `scene` is complete
/// and valid. Thread-safe.
core::Plan planPicture(const core::ParticleSnapshot& particles, const v1::Scene& scene, const core::Camera& camera,
                       core::ImageSize size, float maxPointPixels = 255.0F);

}  // namespace sluice::render
