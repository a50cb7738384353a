#include "planner.h"

#include <algorithm>
#include <iterator>

namespace sluice::render {

Planner::Planner(const v1::Scene& scene, core::ImageSize size, std::span<const DataTraits> liquids,
                 const ReuseTraits& reuse, const DeviceTraits& device)
    : scene_(scene), size_(size), liquids_(liquids), reuse_(reuse) {
  plan_.device = device;
  plan_.surfaces.resize(liquids.size());
}

FramePlan Planner::plan() {
  if (reuse_.picture) {
    allocate(Resource::Picture, PixelFormat::Rgba16f, size_);
    leaveOut("every pass", "particles, camera and look are those of the last frame");
    planToneMap();
    return std::move(plan_);
  }
  plan_.layers = std::max(1, static_cast<int>(liquidsWithSplats()));
  if (isStudy(scene_.view())) {
    forEachLiquid([&] { planSurface(); });
    planStudies();
    planToneMap();
    return std::move(plan_);
  }
  planBodyShadow();
  planBackground();
  planBodies();
  planSunlight();
  if (liquidsWithSplats() == 0) {
    leaveOut("liquid", "no particle is in the picture");
    if (anySpray()) run(Pass::SelectSplats, {Resource::Particles}, {Resource::SplatList});
    planGlassBehind();
  } else {
    forEachLiquid([&] { planSurface(); });
    forEachLiquid([&] { planCubeMap(); });
    planGlassBehind();
    planComposites();
    planBodyEdges();
  }
  planSpray();
  planFoam();
  planGlassBefore();
  planToneMap();
  return std::move(plan_);
}

std::size_t Planner::liquidsWithSplats() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(liquids_, [](const DataTraits& traits) { return traits.splats() > 0; }));
}

bool Planner::anySpray() const {
  return std::ranges::any_of(liquids_, [](const DataTraits& traits) { return traits.sprayDrops > 0; });
}

std::string Planner::named(std::string_view what) const {
  std::string text(what);
  if (liquid_ > 0) text += " of liquid " + std::to_string(liquid_ + 1);
  return text;
}

void Planner::run(Pass pass, std::string name, const std::vector<Resource>& reads, const std::vector<Resource>& writes,
                  int sweeps, int layer) {
  const auto ids = [&](const std::vector<Resource>& resources) {
    std::vector<BufferId> all;
    std::ranges::transform(resources, std::back_inserter(all), [&](Resource resource) { return id(resource); });
    return all;
  };
  plan_.steps.push_back(
      {pass, named(name), ids(reads), ids(writes), sweeps, liquid_, static_cast<std::uint8_t>(layer)});
}

void Planner::leaveOut(std::string_view what, std::string reason) {
  plan_.leftOut.push_back({named(what), std::move(reason)});
}

void Planner::allocate(Resource resource, PixelFormat format, core::ImageSize size) {
  if (plan_.buffer(id(resource)) == nullptr) plan_.buffers.push_back({id(resource), format, size});
}

}  // namespace sluice::render
