#include "planner.h"

namespace sluice::render {

void Planner::planFoam() {
  if (!scene_.has_foam()) {
    leaveOut(Pass::Foam, "the scene has no foam");
    return;
  }
  if (scene_.view().has_normals()) {
    leaveOut(Pass::Foam, "foam is no part of the surface that is shown");
    return;
  }
  if (foamDots() == 0) {
    leaveOut(Pass::Foam, "no secondary particle is in the picture");
    return;
  }
  if (scene_.foam().opacity() <= 0) {
    leaveOut(Pass::Foam, "foam.opacity is 0");
    return;
  }
  beginPicture();
  allocate(Resource::Foam, PixelFormat::R32f, size_);
  PassStep foam{Pass::Foam, std::string(name(Pass::Foam)), {{Resource::Particles}}, {{Resource::Foam}}};
  for (const PictureBuffer& buffer : plan_.buffers) {
    if (buffer.id.resource == Resource::Surface) foam.reads.push_back(buffer.id);
  }
  if (plan_.buffer(Resource::SceneDepth) != nullptr) foam.reads.push_back({Resource::SceneDepth});
  plan_.steps.push_back(std::move(foam));
  run(Pass::BlendFoam, {Resource::Foam}, {Resource::Picture});
}

}  // namespace sluice::render
