#include "planner.h"

namespace sluice::render {

void Planner::planNoise() {
  if (!look().has_noise()) {
    leaveOut(Pass::Noise, "look.noise is not set");
    return;
  }
  const v1::Noise& noise = look().noise();
  if (noise.amplitude() <= 0) {
    leaveOut(Pass::Noise, "look.noise.amplitude is 0");
    return;
  }
  const bool knowsViolence = traits().ids && traits().velocities;
  if (!traits().ids) {
    leaveOut("marks of violent particles", "the source gives no ids; noise goes by the places in its arrays");
  } else if (!traits().velocities) {
    leaveOut("marks of violent particles", "the source gives no velocities");
  }
  if (!knowsViolence && noise.still_share() <= 0) {
    leaveOut(Pass::Noise, "calm particles have none, and the source does not tell which are violent");
    return;
  }
  std::vector<Resource> writes{Resource::Noise};
  allocate(Resource::Noise, PixelFormat::R32f, surfaceSize());
  if (isStudy(scene_.view())) {
    leaveOut("whitening", "the view shows the height alone");
  } else if (noise.whitening() <= 0) {
    leaveOut("whitening", "look.noise.whitening is 0");
  } else if (!knowsViolence) {
    leaveOut("whitening", "the source does not tell which particles are violent");
  } else {
    writes.push_back(Resource::Violence);
    allocate(Resource::Violence, PixelFormat::R32f, surfaceSize());
  }
  if (!plan_.device.software) {
    writes.push_back(Resource::NoiseSums);
    allocate(Resource::NoiseSums, PixelFormat::Rgba32f, surfaceSize());
  }
  run(Pass::Noise, {Resource::Particles, Resource::SplatList, Resource::Surface}, writes);
}

}  // namespace sluice::render
