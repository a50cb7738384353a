#pragma once

#include <memory>
#include <vector>

#include "liquid_state.h"

namespace sluice::render {

/// Hands each liquid its particles, with a state of its own for each new one.
void takeParts(std::vector<std::unique_ptr<LiquidState>>& liquids, const core::ParticleSnapshot& particles);

/// Pixels that hold every splat of particles within `bounds`, however it is stretched.
PixelRect placeOf(const Eigen::AlignedBox3f& bounds, const SplatScale& scale, const ViewGeometry& view);

/// The liquid's own views, coarser where its look says so, and the size of its splats; `spacing` in m.
void aim(LiquidState& liquid, const v1::Look& look, const ViewGeometry& view, double spacing);

/// Takes note of how the liquid's particles have moved, where its look shows noise.
void followViolence(LiquidState& liquid, const v1::Look& look);

}  // namespace sluice::render
