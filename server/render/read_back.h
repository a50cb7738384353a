#pragma once

#include "frame_targets.h"
#include "sluice/render/fluid_renderer.h"

namespace sluice::render {

/// The values of a buffer; empty where there is none.
FloatPicture readValues(FrameTargets& targets, BufferId id);

/// The last picture, or where no liquid is in it, what stands behind.
RadiancePicture readRadiance(FrameTargets& targets);

}  // namespace sluice::render
