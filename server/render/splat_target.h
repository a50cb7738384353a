#pragma once

#include "frame_context.h"

namespace sluice::render {

/// Sets the viewport and the uniform `target` of sphere.glsl for splats into a buffer of this view. Points are drawn in
/// a viewport that reaches beyond it, because GL drops a point whose centre is outside, with all that it covers inside.
void aimSplats(const gl::Program& program, const ViewGeometry& target, bool points);

/// The largest point that splats use, pixels: what the device draws.
float maxPointPixels();

}  // namespace sluice::render
