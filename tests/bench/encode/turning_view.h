#pragma once

#include <vector>

#include "sluice/core/frame.h"

namespace sluice::bench {

/// What a viewer of running water is sent: the shipped scene dam_break with its foam, 1280×720, from 0.6 s on, at 25
/// frames a second, while the camera turns about its target by 0.4° a frame. Throws core::EnvironmentError where there
/// is no GL.
std::vector<core::Frame> turningView(int frames);

}  // namespace sluice::bench
