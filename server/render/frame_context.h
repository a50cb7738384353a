#pragma once

#include <span>

#include "body_mirror.h"
#include "foam_dots.h"
#include "frame_targets.h"
#include "frame_uniforms.h"
#include "liquid_state.h"
#include "sluice/gl/objects.h"
#include "sluice/gl/shader_library.h"
#include "sluice/render/frame_plan.h"
#include "splat_buffers.h"
#include "splat_raster.h"
#include "splat_selection.h"
#include "view_geometry.h"

namespace sluice::render {

/// What a pass may use of the frame that it draws.
struct FrameContext {
  const FramePlan& plan;
  const v1::Scene& scene;
  const ViewGeometry& view;                ///< Of the picture.
  GLuint pictureUniforms;                  ///< The frame's uniforms of passes that draw into the picture.
  std::span<const PixelRect> bodyPlaces;   ///< Where bodies show in it, see placesInPicture.
  std::span<const PixelRect> shadedFloor;  ///< Where the floor is in their shade, see shadedFloor().
  const FrameUniforms& uniforms;           ///< The same.
  SplatRaster& raster;
  std::span<const FoamDot> foam;
  LiquidTargets targets;

  // Of the liquid at hand:
  std::uint8_t liquid;
  std::uint8_t layer;  ///< See PassStep::layer.
  const core::ParticleSnapshot& particles;
  const v1::Look& look;
  const ViewGeometry& surfaceView;    ///< Of the surface, which may be coarser; of its back, in passes that draw that.
  const ViewGeometry& thicknessView;  ///< Of the thickness, likewise.
  const SplatScale& scale;
  SplatShape shape;
  const SplatModel& model;
  const SplatSelection& selection;
  SplatBuffers& splats;
  const BodyMirror& mirror;
  BodyCube& cube;
  const PixelRect& place;  ///< Of the surface, that holds all of the liquid.
  GLuint surfaceUniforms;  ///< The frame's uniforms of passes that draw into the surface, or the shaded liquid.
  GLuint liquidUniforms;
  std::span<const float> violence;  ///< Of each particle, or empty: see NoiseMarks.

  const SurfacePlan& surface() const { return plan.surfaces[liquid]; }
};

/// Where shader programs come from. Fits every pass's constructor.
const gl::ShaderLibrary& shaders();

/// Draws into all of a target from now on, with its uniforms, and with blending, stencil, and clipping off.
void beginTarget(const FrameContext& frame, Resource resource);

/// The same for the stencil of the liquid's surface alone, until endStencil(). The surface is not written and may be
/// read.
void beginStencil(const FrameContext& frame);
void endStencil();

/// Lets shaders read a buffer at a binding of theirs.
void bindTexture(const FrameContext& frame, GLuint binding, Resource resource);

/// Copies one buffer into another of the same size and format.
void copy(const FrameContext& frame, Resource from, Resource to);

/// The stencil where there is liquid, with so many other liquids behind it.
constexpr GLint kLiquidBit = 1;
constexpr GLint stencilOf(int layer) { return kLiquidBit | layer << 1; }

/// From now on draws only where there is liquid,
void keepToLiquid();
/// or where just so many other liquids are behind it.
void keepToLayer(int layer);

/// Draws the triangle that covers the picture; its vertices come from picture.vert or background.vert.
void drawPicture();
/// The same in each of these places alone.
void drawPicture(std::span<const PixelRect> places);

}  // namespace sluice::render
