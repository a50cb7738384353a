#include "planner.h"

namespace sluice::render {

void Planner::planStudies() {
  const v1::View& view = scene_.view();
  leaveOut(Pass::Background, "a study view stands before plain grey");
  leaveOut(Pass::Sunlight, "a study view stands before plain grey");
  leaveOut(Pass::Composite, "a study view is shown");
  leaveOut(Pass::Spray, "a study view is shown");
  allocate(Resource::Picture, PixelFormat::Rgba16f, size_);
  run(Pass::BeginPicture, {}, {Resource::Picture});
  for (int layer = 0; layer < plan_.layers; ++layer) {
    forEachLiquid([&] {
      std::vector<Resource> reads{Resource::Surface};
      if (view.has_thickness()) reads.push_back(Resource::Thickness);
      run(Pass::Study, std::string(name(Pass::Study)), reads, {Resource::Picture}, 1, layer);
      if (view.has_spheres() || view.has_points()) planColourMap(layer);
    });
  }
}

}  // namespace sluice::render
