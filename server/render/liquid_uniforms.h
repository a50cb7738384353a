#pragma once

#include <array>

#include "body_mirror.h"
#include "frame_uniforms.h"
#include "sluice/render/frame_plan.h"
#include "sluice/v1/scene.pb.h"
#include "view_geometry.h"

namespace sluice::render {

/// What passes know of the liquid at hand, as std140 lays it out. Mirrors shaders/liquid_uniforms.glsl, where each
/// member is described; a test compares the two.
struct LiquidUniforms {
  using Vec4 = std::array<float, 4>;

  Vec4 splat;
  Vec4 slopes;
  Vec4 nearDepth;
  Vec4 absorptionAndIndex;
  Vec4 scatterAndShift;
  Vec4 colourAndDiffuse;
  Vec4 gloss;
  Vec4 emission;
  Vec4 reflectance;
  Vec4 cubeAndReach;
  Vec4 mirrorSteps;
  Vec4 sprayTint;
};

/// What spray and foam of a liquid make of white: light goes through walls of the liquid, a particle spacing of them in
/// all, and what these take they scatter in the liquid's own colour.
Eigen::Array3f sprayTint(const v1::Liquid& liquid, double spacing);

/// Whether it sheds light: of opaque liquids that are no metal, some do.
bool glows(const v1::Liquid& liquid);

/// `surface` and `thickness` are the views of the liquid's two buffers.
LiquidUniforms makeLiquidUniforms(const ViewGeometry& surface, const ViewGeometry& thickness, const SplatScale& scale,
                                  const SurfacePlan& plan, const BodyMirror& mirror, const v1::Look& look);

}  // namespace sluice::render
