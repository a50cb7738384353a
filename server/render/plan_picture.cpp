#include "sluice/render/plan_picture.h"

#include "data_traits.h"

namespace sluice::render {

core::Plan planPicture(const core::ParticleSnapshot& particles, const v1::Scene& scene, const core::Camera& camera,
                       core::ImageSize size, float maxPointPixels) {
  const ViewGeometry view = makeViewGeometry(camera, size);
  const SplatScale scale = splatScale(scene.look().splats(), particles.spacing);
  const SplatSelection selection =
      selectSplats(particles.positions, makeSplatModel(particles, scene.look().splats()), view,
                   {scale.radius, scale.dropRadius, scale.nearDepth, maxPointPixels});
  return planFrame(scene, size, dataTraits(particles, selection, scale, view), {}).describe();
}

}  // namespace sluice::render
