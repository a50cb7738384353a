#pragma once

#include <cstddef>

#include "liquid_state.h"
#include "sluice/render/frame_plan.h"

namespace sluice::render {

/// Hands the splats of a liquid, the `k`-th of the plan, to GL: of each kind that a pass of the plan draws there, and
/// no other.
void uploadSplats(LiquidState& liquid, std::size_t k, const FramePlan& plan, const ViewGeometry& view,
                  const DeviceTraits& device);

}  // namespace sluice::render
