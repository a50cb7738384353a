#include "sluice/render/plan_picture.h"

#include "data_traits.h"
#include "foam_dots.h"
#include "liquid_state.h"
#include "study_pass.h"

namespace sluice::render {

core::Plan planPicture(const core::ParticleSnapshot& particles, const v1::Scene& given, const core::Camera& camera,
                       core::ImageSize size, float maxPointPixels) {
  const v1::Scene scene = forItsView(given);
  const ViewGeometry view = makeViewGeometry(camera, size);
  std::vector<DataTraits> traits;
  for (const auto& part : splitByFluid(particles)) {
    const v1::Splats& splats = lookOf(scene, traits.size()).splats();
    const SplatScale scale = splatScale(splats, part->spacing);
    const SplatSelection selection = selectSplats(part->positions, makeSplatModel(*part, splats), view,
                                                  {scale.radius, scale.dropRadius, scale.nearDepth, maxPointPixels});
    traits.push_back(dataTraits(*part, selection, scale, view, lookOf(scene, traits.size())));
  }
  if (scene.has_foam()) {
    traits.front().foamDots = makeFoamDots(particles.diffuse, scene, particles.spacing, view).size();
  }
  return planFrame(scene, size, traits, {}).describe();
}

}  // namespace sluice::render
