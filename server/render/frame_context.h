#pragma once

#include "frame_targets.h"
#include "frame_uniforms.h"
#include "sluice/gl/objects.h"
#include "sluice/gl/shader_library.h"
#include "sluice/render/frame_plan.h"
#include "splat_buffers.h"
#include "view_geometry.h"

namespace sluice::render {

/// What a pass may use of the frame that it draws.
struct FrameContext {
  const FramePlan& plan;
  const ViewGeometry& view;
  const SplatScale& scale;
  const v1::Look& look;
  const v1::Background& background;
  const FrameTargets& targets;
  const SplatBuffers& splats;
};

/// Where shader programs come from. Fits every pass's constructor.
const gl::ShaderLibrary& shaders();

/// Draws into all of a target from now on, with blending, stencil, and clipping off.
void beginTarget(const FrameContext& frame, Resource resource);

/// From now on draws only where there is liquid.
void keepToLiquid();

/// Draws the triangle that covers the picture; its vertices come from picture.vert or background.vert.
void drawPicture();

}  // namespace sluice::render
