#include "sluice/render/frame_plan.h"

#include <algorithm>

#include "planner.h"

namespace sluice::render {

std::string_view name(Pass pass) {
  switch (pass) {
    case Pass::BodyShadow:
      return "body shadow";
    case Pass::Bodies:
      return "bodies";
    case Pass::ClipThickness:
      return "clip thickness";
    case Pass::GlassBehind:
      return "glass behind";
    case Pass::BodyEdges:
      return "body edges";
    case Pass::GlassBefore:
      return "glass before";
    case Pass::Background:
      return "background";
    case Pass::Sunlight:
      return "sunlight";
    case Pass::SelectSplats:
      return "select splats";
    case Pass::Splats:
      return "splats";
    case Pass::LargeSplats:
      return "large splats";
    case Pass::Mask:
      return "mask";
    case Pass::Smoothing:
      return "smoothing";
    case Pass::Thickness:
      return "thickness";
    case Pass::LargeThickness:
      return "large thickness";
    case Pass::SmoothThickness:
      return "smooth thickness";
    case Pass::BackSplats:
      return "back splats";
    case Pass::BackSmoothing:
      return "back smoothing";
    case Pass::Noise:
      return "noise";
    case Pass::CubeMap:
      return "cube map";
    case Pass::BeginPicture:
      return "begin picture";
    case Pass::Layers:
      return "layers";
    case Pass::ExtendScene:
      return "extend scene";
    case Pass::Composite:
      return "composite";
    case Pass::BlendLiquid:
      return "blend liquid";
    case Pass::VelocityMap:
      return "velocity map";
    case Pass::ColourMap:
      return "colour map";
    case Pass::Study:
      return "study";
    case Pass::StudyFoam:
      return "study foam";
    case Pass::Spray:
      return "spray";
    case Pass::Foam:
      return "foam";
    case Pass::BlendFoam:
      return "blend foam";
    case Pass::ToneMap:
      return "tone map";
    case Pass::Legend:
      return "legend";
  }
  return "";
}

std::string_view name(Resource resource) {
  switch (resource) {
    case Resource::Particles:
      return "particles";
    case Resource::SplatList:
      return "splat list";
    case Resource::LightMap:
      return "light map";
    case Resource::BodyShadowMap:
      return "body shadow map";
    case Resource::BodySamples:
      return "body samples";
    case Resource::SceneDepth:
      return "scene depth";
    case Resource::Background:
      return "background";
    case Resource::Scene:
      return "scene";
    case Resource::Surface:
      return "surface";
    case Resource::SurfaceScratch:
      return "surface scratch";
    case Resource::SurfaceScratch2:
      return "surface scratch 2";
    case Resource::SurfaceScratch3:
      return "surface scratch 3";
    case Resource::SurfaceScratch4:
      return "surface scratch 4";
    case Resource::BackSurface:
      return "back surface";
    case Resource::BackCoarse:
      return "coarse back surface";
    case Resource::BackDepth:
      return "back depth";
    case Resource::Stencil:
      return "stencil";
    case Resource::Thickness:
      return "thickness";
    case Resource::ThicknessScratch:
      return "thickness scratch";
    case Resource::Noise:
      return "noise";
    case Resource::NoiseSums:
      return "noise sums";
    case Resource::Violence:
      return "violence";
    case Resource::Attribute:
      return "attribute";
    case Resource::CubeMap:
      return "cube map";
    case Resource::AttributeSums:
      return "attribute sums";
    case Resource::Liquid:
      return "liquid";
    case Resource::Foam:
      return "foam";
    case Resource::Picture:
      return "picture";
    case Resource::Screen:
      return "screen";
  }
  return "";
}

bool isSurface(Resource resource) {
  return resource == Resource::Surface || resource == Resource::BackSurface || resource == Resource::BackCoarse ||
         resource == Resource::BackDepth || std::ranges::find(kSurfaceScratch, resource) != kSurfaceScratch.end();
}

bool isAsFineAsSurface(Resource resource) {
  switch (resource) {
    case Resource::Noise:
    case Resource::NoiseSums:
    case Resource::Violence:
    case Resource::Liquid:
      return true;
    default:
      return isSurface(resource);
  }
}

bool isOfLiquid(Resource resource) {
  switch (resource) {
    case Resource::SplatList:
    case Resource::Stencil:
    case Resource::Thickness:
    case Resource::ThicknessScratch:
    case Resource::Attribute:
    case Resource::CubeMap:
    case Resource::AttributeSums:
      return true;
    default:
      return isAsFineAsSurface(resource);
  }
}

bool isKeptByItsPass(Resource resource) {
  return resource == Resource::BodySamples || resource == Resource::BodyShadowMap || resource == Resource::CubeMap;
}

std::uint64_t bytesPerPixel(PixelFormat format) {
  switch (format) {
    case PixelFormat::Rgba32f:
      return 16;
    case PixelFormat::Rgba16f:
    case PixelFormat::Rg32f:
      return 8;
    case PixelFormat::Rgba16fDepth32fTimes4:
      return 48;
    case PixelFormat::Rgba16fRg32fTimes6:
      return 96;
    case PixelFormat::Srgb8Alpha8:
    case PixelFormat::R32f:
      return 4;
    case PixelFormat::Stencil8:
      return 1;
  }
  return 0;
}

std::uint64_t PictureBuffer::bytes() const {
  if (sharedWith) return 0;
  return bytesPerPixel(format) * static_cast<std::uint64_t>(size.width) * static_cast<std::uint64_t>(size.height);
}

bool FramePlan::runs(Pass pass) const { return std::ranges::find(steps, pass, &PassStep::pass) != steps.end(); }

bool FramePlan::runs(Pass pass, std::size_t liquid) const {
  return std::ranges::any_of(steps, [&](const PassStep& step) { return step.pass == pass && step.liquid == liquid; });
}

const PictureBuffer* FramePlan::buffer(BufferId id) const {
  const auto found = std::ranges::find(buffers, id, &PictureBuffer::id);
  return found == buffers.end() ? nullptr : &*found;
}

const PictureBuffer* FramePlan::buffer(Resource resource, std::size_t liquid) const {
  return buffer({resource, isOfLiquid(resource) ? static_cast<std::uint8_t>(liquid) : std::uint8_t{0}});
}

namespace {

std::string describe(BufferId id) {
  std::string text(name(id.resource));
  if (id.liquid > 0) text += " of liquid " + std::to_string(id.liquid + 1);
  return text;
}

}  // namespace

core::Plan FramePlan::describe() const {
  const auto names = [](const std::vector<BufferId>& ids) {
    std::vector<std::string> texts;
    for (const BufferId& id : ids) texts.push_back(render::describe(id));
    return texts;
  };
  core::Plan plan;
  for (const PassStep& step : steps) {
    plan.stages.push_back({step.name, names(step.reads), names(step.writes), step.sweeps});
  }
  for (const PictureBuffer& buffer : buffers) {
    std::string label = render::describe(buffer.id);
    if (buffer.sharedWith) label += " (in the memory of " + render::describe(*buffer.sharedWith) + ")";
    plan.buffers.push_back({std::move(label), buffer.bytes()});
  }
  plan.leftOut = leftOut;
  return plan;
}

core::ImageSize dividedSize(core::ImageSize size, unsigned divisor) {
  const auto d = static_cast<int>(divisor);
  return {(size.width + d - 1) / d, (size.height + d - 1) / d};
}

namespace {

/// When a buffer holds something: from one step to another, both counted.
struct Lifetime {
  std::size_t first;
  std::size_t last;

  bool meets(const Lifetime& other) const { return first <= other.last && other.first <= last; }
};

Lifetime lifetimeOf(BufferId id, const std::vector<PassStep>& steps) {
  const Resource resource = id.resource;
  // Kept for the next frame, or given away after this one.
  if (resource == Resource::Background || resource == Resource::SceneDepth || resource == Resource::Stencil ||
      isKeptByItsPass(resource)) {
    return {0, steps.size()};
  }
  Lifetime life{steps.size(), 0};
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const auto has = [&](const std::vector<BufferId>& ids) { return std::ranges::find(ids, id) != ids.end(); };
    if (!has(steps[i].reads) && !has(steps[i].writes)) continue;
    life.first = std::min(life.first, i);
    life.last = i;
  }
  const bool isResult = resource == Resource::Picture || resource == Resource::Screen ||
                        resource == Resource::Surface || resource == Resource::BackSurface ||
                        resource == Resource::Thickness || resource == Resource::Noise ||
                        resource == Resource::Violence || resource == Resource::Foam;
  if (isResult) life.last = steps.size();
  return life;
}

/// Lets buffers that never hold anything at the same time use the same memory.
void shareMemory(FramePlan& plan) {
  std::vector<PictureBuffer>& buffers = plan.buffers;
  for (PictureBuffer& buffer : buffers) {
    if (isKeptByItsPass(buffer.id.resource)) continue;
    const Lifetime life = lifetimeOf(buffer.id, plan.steps);
    const auto fits = [&](const PictureBuffer& other) {
      if (&other == &buffer || other.sharedWith || isKeptByItsPass(other.id.resource) || other.size != buffer.size ||
          bytesPerPixel(other.format) != bytesPerPixel(buffer.format)) {
        return false;
      }
      // Everything in that memory has to be out of the way.
      return std::ranges::none_of(buffers, [&](const PictureBuffer& tenant) {
        const bool isThere = tenant.id == other.id || tenant.sharedWith == other.id;
        return isThere && lifetimeOf(tenant.id, plan.steps).meets(life);
      });
    };
    const bool isOwner =
        std::ranges::any_of(buffers, [&](const PictureBuffer& other) { return other.sharedWith == buffer.id; });
    if (isOwner) continue;
    const auto found = std::ranges::find_if(buffers, fits);
    if (found != buffers.end()) buffer.sharedWith = found->id;
  }
}

}  // namespace

const v1::Look& lookOf(const v1::Scene& scene, std::size_t liquid) {
  const auto further = static_cast<int>(liquid) - 1;
  return further >= 0 && further < scene.more_looks_size() ? scene.more_looks(further) : scene.look();
}

FramePlan planFrame(const v1::Scene& scene, core::ImageSize size, std::span<const DataTraits> liquids,
                    const ReuseTraits& reuse, const DeviceTraits& device) {
  FramePlan plan = Planner(scene, size, liquids, reuse, device).plan();
  shareMemory(plan);
  return plan;
}

}  // namespace sluice::render
