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

Eigen::Array3f colourOf(const v1::Vec3& c) { return Eigen::Array3d(c.x(), c.y(), c.z()).cast<float>(); }

}  // namespace

Eigen::Array3f sprayTint(const v1::Liquid& liquid, double spacing) {
  if (liquid.has_metal()) return colourOf(liquid.metal().reflectance());
  if (liquid.opaque()) return colourOf(liquid.colour());
  const Eigen::Array3f through = (-static_cast<float>(spacing) * colourOf(liquid.absorption())).exp();
  return through + (1.0F - through) * colourOf(liquid.scatter_colour());
}

bool glows(const v1::Liquid& liquid) { return liquid.opaque() && !liquid.has_metal(); }

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
  u.sprayTint = pack(sprayTint(liquid, scale.spacing).matrix(), glows(liquid) ? 1.0F : 0.0F);
  u.mirrorSteps = {static_cast<float>(mirror.steps), 0.0F, 0.0F, 0.0F};
  return u;
}

}  // namespace sluice::render
