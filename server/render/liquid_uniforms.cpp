#include "liquid_uniforms.h"

#include "pack.h"

namespace sluice::render {

namespace {

LiquidUniforms::Vec4 glossOf(const v1::Liquid& liquid) {
  if (liquid.has_phong()) {
    return {static_cast<float>(liquid.phong().shininess()), static_cast<float>(liquid.phong().specular()), 0.0F, 0.0F};
  }
  return {static_cast<float>(liquid.physical().roughness()), static_cast<float>(liquid.physical().specular()), 0.0F,
          0.0F};
}

}  // namespace

LiquidUniforms makeLiquidUniforms(const ViewGeometry& surface, const ViewGeometry& thickness, const SplatScale& scale,
                                  const SurfacePlan& plan, const BodyMirror& mirror, const v1::Look& look) {
  const v1::Liquid& liquid = look.liquid();
  LiquidUniforms u{};
  u.splat = {scale.radius, scale.dropRadius, scale.spacing, plan.flatRims ? kRimDepth : 0.0F};
  u.slopes = {thickness.maxSlope.x(), thickness.maxSlope.y(), surface.maxSlope.x(), surface.maxSlope.y()};
  u.nearDepth = {scale.nearDepth, 0.0F, 0.0F, 0.0F};
  u.absorptionAndIndex = pack(liquid.absorption(), liquid.refractive_index());
  u.scatterAndShift = pack(liquid.scatter_colour(), liquid.screen_shift().strength());
  u.colourAndDiffuse = pack(liquid.colour(), liquid.phong().diffuse());
  u.gloss = glossOf(liquid);
  u.emission = pack(liquid.emission());
  u.reflectance = pack(liquid.metal().reflectance());
  u.cubeAndReach = pack(mirror.middle, mirror.reach);
  u.mirrorSteps = {static_cast<float>(mirror.steps), 0.0F, 0.0F, 0.0F};
  return u;
}

}  // namespace sluice::render
