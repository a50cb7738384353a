#include "planner.h"

namespace sluice::render {

void Planner::planStudies() {
  const v1::View& view = scene_.view();
  leaveOut(Pass::Background, "a study view stands before plain grey");
  leaveOut(Pass::Sunlight, "a study view stands before plain grey");
  leaveOut(Pass::Composite, "a study view is shown");
  leaveOut(Pass::Spray, "a study view is shown");
  if (!view.has_foam()) leaveOut(Pass::Foam, "the view does not show it");
  allocate(Resource::Picture, PixelFormat::Rgba16f, size_);
  run(Pass::BeginPicture, {}, {Resource::Picture});
  for (int layer = 0; layer < plan_.layers; ++layer) {
    forEachLiquid([&] {
      std::vector<Resource> reads{Resource::Surface};
      for (const Resource values : {Resource::Thickness, Resource::Noise}) {
        if (plan_.buffer(id(values)) != nullptr) reads.push_back(values);
      }
      run(Pass::Study, std::string(name(Pass::Study)), reads, {Resource::Picture}, 1, layer);
      if (view.has_spheres() || view.has_points()) planColourMap(layer);
    });
  }
  if (view.has_foam() && planFoamDepth()) run(Pass::StudyFoam, {Resource::Foam}, {Resource::Picture});
}

}  // namespace sluice::render
