#include "composite_variant.h"
#include "planner.h"

namespace sluice::render {

void Planner::beginPicture() {
  if (plan_.runs(Pass::BeginPicture)) return;
  allocate(Resource::Picture, PixelFormat::Rgba16f, size_);
  run(Pass::BeginPicture, {sceneUnderLiquid()}, {Resource::Picture});
}

void Planner::planComposites() {
  // A liquid is seen through those before it: what each adds to the scene is drawn before the next looks it up.
  if (plan_.layers > 1) {
    allocate(Resource::Scene, PixelFormat::Rgba16f, size_);
  } else {
    leaveOut(Pass::ExtendScene, "there is but one liquid in the picture");
    leaveOut(Pass::Layers, "there is but one liquid in the picture");
  }
  beginPicture();
  if (plan_.layers > 1) {
    forEachLiquid([&] { run(Pass::Layers, {Resource::Surface, Resource::Stencil}, {Resource::Stencil}); });
  }
  for (int layer = 0; layer < plan_.layers; ++layer) {
    if (layer > 0) {
      run(Pass::ExtendScene, {Resource::Picture}, {Resource::Scene});
      hasScene_ = true;
    }
    forEachLiquid([&] { planComposite(layer); });
  }
}

void Planner::planComposite(int layer) {
  const v1::Liquid& liquid = look().liquid();
  std::vector<Resource> reads{Resource::Surface, Resource::Stencil};
  if (looksUpScene(compositeVariant(liquid, scene_, plan_.layers > 1))) reads.push_back(sceneUnderLiquid());
  if (!isOpaque(liquid)) reads.push_back(Resource::Thickness);
  if (refractionOf(liquid) == Refraction::TwoInterfaces) reads.push_back(Resource::BackSurface);
  if (!whyNoCubeMap(liquid, scene_)) reads.push_back(Resource::CubeMap);
  if (hasBodies()) reads.push_back(Resource::SceneDepth);
  for (const Resource noise : {Resource::Noise, Resource::Violence}) {
    if (plan_.buffer(id(noise)) != nullptr) reads.push_back(noise);
  }
  if (layer == 0) leaveOutOptics();
  if (look().smoothing().divisor() == 1) {
    run(Pass::Composite, std::string(name(Pass::Composite)), reads, {Resource::Picture}, 1, layer);
    if (layer == 0) leaveOut(Pass::BlendLiquid, "the liquid is as fine as the picture");
  } else {
    allocate(Resource::Liquid, PixelFormat::Rgba16f, surfaceSize());
    run(Pass::Composite, std::string(name(Pass::Composite)), reads, {Resource::Liquid}, 1, layer);
    run(Pass::BlendLiquid, std::string(name(Pass::BlendLiquid)), {sceneUnderLiquid(), Resource::Liquid},
        {Resource::Picture}, 1, layer);
  }
  planVelocityMap(layer);
  planColourMap(layer);
}

void Planner::leaveOutOptics() {
  const v1::Liquid& liquid = look().liquid();
  const v1::Lighting& lighting = scene_.lighting();
  if (!hasHighlight(liquid, lighting)) {
    const char* const specular =
        liquid.has_phong() ? "look.liquid.phong.specular is 0" : "look.liquid.physical.specular is 0";
    leaveOut("specular highlight", lighting.sun().strength() > 0 ? specular : "lighting.sun.strength is 0");
  }
  if (const auto why = whyNoReflection(liquid, scene_.background())) leaveOut("reflection", *why);
  const auto plain = whyPlainBehind(scene_, plan_.layers > 1);
  if (plain && !isOpaque(liquid)) leaveOut("refraction's look-up", *plain);
}

void Planner::planSpray() {
  for (std::size_t k = 0; k < liquids_.size(); ++k) {
    forLiquid(k);
    if (traits().sprayDrops > 0) {
      beginPicture();
      std::vector<Resource> reads{Resource::Particles, Resource::SplatList};
      if (traits().splats() > 0) reads.push_back(Resource::Surface);
      run(Pass::Spray, reads, {Resource::Picture});
    } else if (look().splats().stray_density() <= 0) {
      leaveOut(Pass::Spray, "look.splats.stray_density is 0");
    } else if (!traits().densities) {
      leaveOut(Pass::Spray, "the source gives no densities");
    } else {
      leaveOut(Pass::Spray, "no particle in the picture is far from the rest");
    }
  }
  forTheScene();
}

void Planner::planToneMap() {
  const bool hasPicture = plan_.buffer(Resource::Picture) != nullptr;
  if (!plan_.device.software) allocate(Resource::Screen, PixelFormat::Srgb8Alpha8, size_);
  run(Pass::ToneMap, {hasPicture ? Resource::Picture : Resource::Background}, {Resource::Screen});
  planLegend();
}

}  // namespace sluice::render
