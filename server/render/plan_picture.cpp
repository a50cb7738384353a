#include "sluice/render/plan_picture.h"

#include "frame_uniforms.h"
#include "sluice/render/frame_plan.h"
#include "splat_selection.h"

namespace sluice::render {

core::Plan planPicture(const core::ParticleSnapshot& particles, const v1::Look& look, const v1::Background& background,
                       const core::Camera& camera, core::ImageSize size, float maxPointPixels) {
  const ViewGeometry view = makeViewGeometry(camera, size);
  const SplatScale scale = splatScale(look.splats(), particles.spacing);
  const SplatSelection selection =
      selectSplats(particles.positions, view, {scale.radius, scale.nearDepth, maxPointPixels});
  DataTraits traits;
  traits.spacing = scale.spacing;
  traits.points = selection.points.size();
  traits.hiddenPoints = selection.points.size() - selection.visiblePoints;
  traits.largeSplats = selection.large.size();
  traits.nearestDepth = selection.nearestDepth;
  traits.pixelSlope = view.pixelSlope;
  return planFrame(look, background, size, traits, {}).describe();
}

}  // namespace sluice::render
