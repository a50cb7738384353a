#include "planner.h"

namespace sluice::render {

void Planner::planFoam() {
  if (planFoamDepth()) run(Pass::BlendFoam, {Resource::Foam}, {Resource::Picture});
}

bool Planner::planFoamDepth() {
  if (!scene_.has_foam()) {
    leaveOut(Pass::Foam, "the scene has no foam");
    return false;
  }
  if (foamDots() == 0) {
    leaveOut(Pass::Foam, "no secondary particle is in the picture");
    return false;
  }
  if (scene_.foam().opacity() <= 0) {
    leaveOut(Pass::Foam, "foam.opacity is 0");
    return false;
  }
  beginPicture();
  allocate(Resource::Foam, PixelFormat::R32f, size_);
  PassStep foam{Pass::Foam, std::string(name(Pass::Foam)), {{Resource::Particles}}, {{Resource::Foam}}};
  for (const PictureBuffer& buffer : plan_.buffers) {
    if (buffer.id.resource == Resource::Surface) foam.reads.push_back(buffer.id);
  }
  if (plan_.buffer(Resource::SceneDepth) != nullptr) foam.reads.push_back({Resource::SceneDepth});
  plan_.steps.push_back(std::move(foam));
  return true;
}

}  // namespace sluice::render
