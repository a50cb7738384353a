#include "planner.h"

namespace sluice::render {

void Planner::planVelocityMap(int layer) {
  const v1::VelocityMap& map = look().velocity_map();
  std::string reason;
  if (!look().has_velocity_map()) {
    reason = "the look has none";
  } else if (map.strength() <= 0) {
    reason = "look.velocity_map.strength is 0";
  } else {
    reason = traits().velocityMapMissing;
  }
  planMap(Pass::VelocityMap, reason, layer);
}

void Planner::planColourMap(int layer) {
  const v1::ColourMap& map = look().colour_map();
  std::string reason;
  if (!look().has_colour_map()) {
    reason = "the look has none";
  } else if (map.strength() <= 0) {
    reason = "look.colour_map.strength is 0";
  } else {
    reason = traits().colourMapMissing;
  }
  planMap(Pass::ColourMap, reason, layer);
}

void Planner::planMap(Pass pass, const std::string& missing, int layer) {
  if (!missing.empty()) {
    if (layer == 0) leaveOut(pass, missing);
    return;
  }
  const core::ImageSize size = dividedSize(surfaceSize(), 2);
  std::vector<Resource> writes{Resource::Attribute, Resource::Picture};
  allocate(Resource::Attribute, PixelFormat::R32f, size);
  if (!plan_.device.software) {
    allocate(Resource::AttributeSums, PixelFormat::Rg32f, size);
    writes.push_back(Resource::AttributeSums);
  }
  run(pass, std::string(name(pass)), {Resource::Particles, Resource::SplatList, Resource::Surface}, writes, 1, layer);
}

}  // namespace sluice::render
