#include "liquid_uniforms.h"

#include "pack.h"

namespace sluice::render {

LiquidUniforms makeLiquidUniforms(const ViewGeometry& surface, const ViewGeometry& thickness, const SplatScale& scale,
                                  const SurfacePlan& plan, const v1::Look& look) {
  const v1::Liquid& liquid = look.liquid();
  LiquidUniforms u{};
  u.splat = {scale.radius, scale.dropRadius, scale.spacing, plan.flatRims ? kRimDepth : 0.0F};
  u.slopes = {thickness.maxSlope.x(), thickness.maxSlope.y(), surface.maxSlope.x(), surface.maxSlope.y()};
  u.nearDepth = {scale.nearDepth, 0.0F, 0.0F, 0.0F};
  u.absorptionAndIndex = pack(liquid.absorption(), liquid.refractive_index());
  u.scatterAndGloss = pack(liquid.scatter_colour(), liquid.physical().roughness());
  u.colourAndSpecular = pack(liquid.colour(), liquid.physical().specular());
  return u;
}

}  // namespace sluice::render
