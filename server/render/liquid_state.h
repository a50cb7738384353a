#pragma once

#include <memory>
#include <vector>

#include "body_mirror.h"
#include "frame_uniforms.h"
#include "noise_marks.h"
#include "pixel_rects.h"
#include "sluice/core/particle_snapshot.h"
#include "sluice/gl/objects.h"
#include "splat_buffers.h"
#include "splat_model.h"
#include "splat_selection.h"
#include "view_geometry.h"

namespace sluice::render {

/// The particles of each liquid of a snapshot: the snapshot itself where there is but one. At least one.
std::vector<std::shared_ptr<const core::ParticleSnapshot>> splitByFluid(const core::ParticleSnapshot& particles);

/// What a renderer knows of one liquid, and keeps from frame to frame.
struct LiquidState {
  std::shared_ptr<const core::ParticleSnapshot> particles;
  Eigen::AlignedBox3f bounds;  ///< Of the particles.
  SplatModel model;
  v1::Splats splatsOfModel;
  NoiseMarks marks;
  BodyCube cube;

  // Of the frame at hand.
  ViewGeometry surfaceView;
  ViewGeometry backView;
  ViewGeometry thicknessView;
  SplatScale scale;
  PixelRect place;  ///< Of the surface, that holds all of the liquid.
  SplatSelection selection;
  BodyMirror mirror;

  SplatBuffers splats;
  gl::StreamBuffer surfaceUniforms;  ///< FrameUniforms of passes that draw into the surface.
  gl::StreamBuffer backUniforms;     ///< The same of the back surface, where it is drawn.
  gl::StreamBuffer liquidUniforms;
};

}  // namespace sluice::render
