#include "sluice/render/plan_picture.h"

#include "data_traits.h"
#include "liquid_state.h"

namespace sluice::render {

core::Plan planPicture(const core::ParticleSnapshot& particles, const v1::Scene& scene, const core::Camera& camera,
                       core::ImageSize size, float maxPointPixels) {
  const ViewGeometry view = makeViewGeometry(camera, size);
  std::vector<DataTraits> traits;
  for (const auto& part : splitByFluid(particles)) {
    const v1::Splats& splats = lookOf(scene, traits.size()).splats();
    const SplatScale scale = splatScale(splats, part->spacing);
    const SplatSelection selection = selectSplats(part->positions, makeSplatModel(*part, splats), view,
                                                  {scale.radius, scale.dropRadius, scale.nearDepth, maxPointPixels});
    traits.push_back(dataTraits(*part, selection, scale, view));
  }
  return planFrame(scene, size, traits, {}).describe();
}

}  // namespace sluice::render
