#include "sluice/render/frame_plan.h"

#include <algorithm>
#include <iterator>
#include <span>

#include "interior_particles.h"
#include "smoothing/smoothing_method.h"

namespace sluice::render {

std::string_view name(Pass pass) {
  switch (pass) {
    case Pass::Background:
      return "background";
    case Pass::GroundShadow:
      return "ground shadow";
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
    case Pass::Composite:
      return "composite";
    case Pass::BlendLiquid:
      return "blend liquid";
    case Pass::Spray:
      return "spray";
  }
  return "";
}

std::string_view name(Resource resource) {
  switch (resource) {
    case Resource::Particles:
      return "particles";
    case Resource::SplatList:
      return "splat list";
    case Resource::ShadowMap:
      return "shadow map";
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
    case Resource::Stencil:
      return "stencil";
    case Resource::Thickness:
      return "thickness";
    case Resource::ThicknessScratch:
      return "thickness scratch";
    case Resource::Liquid:
      return "liquid";
    case Resource::Picture:
      return "picture";
  }
  return "";
}

bool isSurface(Resource resource) {
  return resource == Resource::Surface || std::ranges::find(kSurfaceScratch, resource) != kSurfaceScratch.end();
}

std::uint64_t bytesPerPixel(PixelFormat format) { return format == PixelFormat::Stencil8 ? 1 : 4; }

std::uint64_t PictureBuffer::bytes() const {
  if (sharedWith) return 0;
  return bytesPerPixel(format) * static_cast<std::uint64_t>(size.width) * static_cast<std::uint64_t>(size.height);
}

bool FramePlan::runs(Pass pass) const { return std::ranges::find(steps, pass, &PassStep::pass) != steps.end(); }

const PictureBuffer* FramePlan::buffer(Resource resource) const {
  const auto found = std::ranges::find(buffers, resource, &PictureBuffer::resource);
  return found == buffers.end() ? nullptr : &*found;
}

core::Plan FramePlan::describe() const {
  const auto names = [](const std::vector<Resource>& resources) {
    std::vector<std::string> texts;
    for (const Resource resource : resources) texts.emplace_back(name(resource));
    return texts;
  };
  core::Plan plan;
  for (const PassStep& step : steps) {
    plan.stages.push_back({step.name, names(step.reads), names(step.writes), step.sweeps});
  }
  for (const PictureBuffer& buffer : buffers) {
    std::string label(name(buffer.resource));
    if (buffer.sharedWith) label += " (in the memory of " + std::string(name(*buffer.sharedWith)) + ")";
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

Lifetime lifetimeOf(Resource resource, const std::vector<PassStep>& steps) {
  // Kept for the next frame, or given away after this one.
  if (resource == Resource::Background || resource == Resource::Stencil) return {0, steps.size()};
  Lifetime life{steps.size(), 0};
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const auto has = [&](const std::vector<Resource>& resources) {
      return std::ranges::find(resources, resource) != resources.end();
    };
    if (!has(steps[i].reads) && !has(steps[i].writes)) continue;
    life.first = std::min(life.first, i);
    life.last = i;
  }
  const bool isResult =
      resource == Resource::Picture || resource == Resource::Surface || resource == Resource::Thickness;
  if (isResult) life.last = steps.size();
  return life;
}

/// Lets buffers that never hold anything at the same time use the same memory. A pixel of either format has four bytes.
void shareMemory(FramePlan& plan) {
  std::vector<PictureBuffer>& buffers = plan.buffers;
  for (PictureBuffer& buffer : buffers) {
    const Lifetime life = lifetimeOf(buffer.resource, plan.steps);
    const auto fits = [&](const PictureBuffer& other) {
      if (&other == &buffer || other.sharedWith || other.size != buffer.size ||
          bytesPerPixel(other.format) != bytesPerPixel(buffer.format)) {
        return false;
      }
      // Everything in that memory has to be out of the way.
      return std::ranges::none_of(buffers, [&](const PictureBuffer& tenant) {
        const bool isThere = tenant.resource == other.resource || tenant.sharedWith == other.resource;
        return isThere && lifetimeOf(tenant.resource, plan.steps).meets(life);
      });
    };
    const bool isOwner =
        std::ranges::any_of(buffers, [&](const PictureBuffer& other) { return other.sharedWith == buffer.resource; });
    if (isOwner) continue;
    const auto found = std::ranges::find_if(buffers, fits);
    if (found != buffers.end()) buffer.sharedWith = found->resource;
  }
}

/// Builds a plan from the top down; one function per part of the frame.
class Planner {
 public:
  Planner(const v1::Scene& scene, core::ImageSize size, const DataTraits& traits, const ReuseTraits& reuse,
          const DeviceTraits& device)
      : look_(scene.look()),
        background_(scene.background()),
        sun_(scene.lighting().sun()),
        size_(size),
        surfaceSize_(dividedSize(size, scene.look().smoothing().divisor())),
        traits_(traits),
        reuse_(reuse) {
    plan_.device = device;
  }

  FramePlan plan() {
    if (reuse_.picture) {
      allocate(Resource::Picture, PixelFormat::Srgb8Alpha8, size_);
      leaveOut("every pass", "particles, camera and look are those of the last frame");
      return std::move(plan_);
    }
    planBackground();
    if (traits_.splats() == 0) {
      leaveOut("liquid", "no particle is in the picture");
      if (traits_.sprayDrops > 0) run(Pass::SelectSplats, {Resource::Particles}, {Resource::SplatList});
    } else {
      planSplats();
      planSmoothing();
      planThickness();
      planComposite();
    }
    planSpray();
    return std::move(plan_);
  }

 private:
  void run(Pass pass, std::vector<Resource> reads, std::vector<Resource> writes) {
    run(pass, std::string(name(pass)), std::move(reads), std::move(writes));
  }
  void run(Pass pass, std::string name, std::vector<Resource> reads, std::vector<Resource> writes, int sweeps = 1) {
    plan_.steps.push_back({pass, std::move(name), std::move(reads), std::move(writes), sweeps});
  }
  void leaveOut(Pass pass, std::string reason) { leaveOut(name(pass), std::move(reason)); }
  void leaveOut(std::string_view what, std::string reason) {
    plan_.leftOut.push_back({std::string(what), std::move(reason)});
  }
  void allocate(Resource resource, PixelFormat format, core::ImageSize size) {
    plan_.buffers.push_back({resource, format, size});
  }

  void planBackground() {
    allocate(Resource::Background, PixelFormat::Srgb8Alpha8, size_);
    if (reuse_.background) {
      leaveOut(Pass::Background, "camera, size and background are those of the last frame");
    } else {
      run(Pass::Background, {}, {Resource::Background});
    }
    if (traits_.splats() + traits_.sprayDrops == 0) return;
    if (!background_.floor()) {
      leaveOut(Pass::GroundShadow, "there is no floor");
    } else if (sun_.shadow() <= 0) {
      leaveOut(Pass::GroundShadow, "lighting.sun.shadow is 0");
    } else {
      hasShadow_ = true;
      allocate(Resource::Scene, PixelFormat::Srgb8Alpha8, size_);
      run(Pass::GroundShadow, {Resource::Particles, Resource::Background}, {Resource::ShadowMap, Resource::Scene});
    }
  }

  void planSplats() {
    const v1::Splats& splats = look_.splats();
    if (splats.radius_by_density() && !traits_.densities) {
      leaveOut("radius by density", "the source gives no densities");
    }
    if (!splats.skip_interior()) {
      leaveOut("search for interior particles", "look.splats.skip_interior is off");
    } else if (!traits_.neighbourCounts) {
      // Densities do not tell: next to a wall they are as high as inside, and the liquid there is seen through it.
      leaveOut("search for interior particles", "the source gives no numbers of neighbours");
    } else if (splats.radius_in_spacings() < kLeastRadiusOfInterior) {
      leaveOut("search for interior particles", "small splats leave gaps through which they are seen");
    }
    allocate(Resource::Surface, PixelFormat::R32f, surfaceSize_);
    run(Pass::SelectSplats, {Resource::Particles}, {Resource::SplatList});
    if (traits_.points > 0) run(Pass::Splats, {Resource::Particles, Resource::SplatList}, {Resource::Surface});
    if (traits_.interiorPoints > 0) {
      leaveOut("splats of " + std::to_string(traits_.interiorPoints) + " particles", "they are deep inside the liquid");
    }
    if (traits_.hiddenPoints > traits_.interiorPoints) {
      leaveOut("splats of " + std::to_string(traits_.hiddenPoints - traits_.interiorPoints) + " particles",
               "they lie wholly behind others");
    }
    if (traits_.largeSplats > 0) {
      run(Pass::LargeSplats, {Resource::Particles, Resource::SplatList}, {Resource::Surface});
    } else {
      leaveOut(Pass::LargeSplats, "every splat is small enough to be a point");
    }
    allocate(Resource::Stencil, PixelFormat::Stencil8, surfaceSize_);
  }

  void planMask() { run(Pass::Mask, {Resource::Surface}, {Resource::Stencil}); }

  void planSmoothing() {
    const v1::Smoothing& smoothing = look_.smoothing();
    if (smoothing.time() <= 0) {
      leaveOut("smoothing", "look.smoothing.time is 0");
      planMask();
      return;
    }
    const SmoothingMethodEntry* const method = findSmoothingMethod(smoothing.method_case());
    if (method == nullptr) {
      leaveOut("smoothing", "no method is chosen");
      planMask();
      return;
    }
    SurfaceTraits surface;
    surface.spacing = traits_.spacing;
    surface.splatRadius = look_.splats().radius_in_spacings() * traits_.spacing;
    surface.nearestDepth = traits_.nearestDepth;
    surface.pixelSlope = traits_.pixelSlope * smoothing.divisor();
    surface.size = surfaceSize_;
    surface.device = plan_.device;
    SmoothingPlan needs = method->plan(smoothing, surface);

    std::vector<Resource> reads{Resource::Surface};
    std::vector<Resource> writes{Resource::Surface};
    if (needs.mask) {
      planMask();
      reads.push_back(Resource::Stencil);
    }
    for (const Resource scratch : std::span(kSurfaceScratch).first(needs.scratch)) {
      allocate(scratch, PixelFormat::R32f, surfaceSize_);
      writes.push_back(scratch);
    }
    plan_.flow = needs.flow;
    plan_.flatRims = needs.flatRims;
    std::ranges::move(needs.leftOut, std::back_inserter(plan_.leftOut));
    run(Pass::Smoothing, smoothingName(smoothing.method_case()), std::move(reads), std::move(writes), needs.sweeps);
    if (!needs.mask || needs.erodes) planMask();
  }

  void planThickness() {
    if (look_.liquid().opaque()) {
      leaveOut(Pass::Thickness, "the liquid is opaque");
      leaveOut("refraction", "the liquid is opaque");
      return;
    }
    allocate(Resource::Thickness, PixelFormat::R32f, dividedSize(size_, look_.thickness().divisor()));
    if (traits_.points > 0) run(Pass::Thickness, {Resource::Particles, Resource::SplatList}, {Resource::Thickness});
    if (traits_.largeSplats > 0) {
      run(Pass::LargeThickness, {Resource::Particles, Resource::SplatList}, {Resource::Thickness});
    }
    if (look_.thickness().smoothing_in_spacings() > 0) {
      std::vector<Resource> writes{Resource::Thickness};
      if (!plan_.device.software) {
        allocate(Resource::ThicknessScratch, PixelFormat::R32f, dividedSize(size_, look_.thickness().divisor()));
        writes.push_back(Resource::ThicknessScratch);
      }
      run(Pass::SmoothThickness, {Resource::Thickness, Resource::Surface}, std::move(writes));
    } else {
      leaveOut(Pass::SmoothThickness, "look.thickness.smoothing_in_spacings is 0");
    }
  }

  void planComposite() {
    const Resource scene = hasShadow_ ? Resource::Scene : Resource::Background;
    std::vector<Resource> reads{scene, Resource::Surface, Resource::Stencil};
    if (!look_.liquid().opaque()) reads.push_back(Resource::Thickness);
    if (look_.liquid().physical().specular() <= 0) leaveOut("specular highlight", "look.liquid.physical.specular is 0");
    if (look_.smoothing().divisor() == 1) {
      run(Pass::Composite, std::move(reads), {Resource::Picture});
      leaveOut(Pass::BlendLiquid, "the liquid is as fine as the picture");
    } else {
      allocate(Resource::Liquid, PixelFormat::Srgb8Alpha8, surfaceSize_);
      run(Pass::Composite, std::move(reads), {Resource::Liquid});
      run(Pass::BlendLiquid, {scene, Resource::Liquid}, {Resource::Picture});
    }
    allocate(Resource::Picture, PixelFormat::Srgb8Alpha8, size_);
  }

  void planSpray() {
    if (traits_.sprayDrops > 0) {
      std::vector<Resource> reads{Resource::Particles, Resource::SplatList};
      if (traits_.splats() > 0) {
        reads.push_back(Resource::Surface);
      } else {
        reads.push_back(hasShadow_ ? Resource::Scene : Resource::Background);
        allocate(Resource::Picture, PixelFormat::Srgb8Alpha8, size_);
      }
      run(Pass::Spray, std::move(reads), {Resource::Picture});
    } else if (look_.splats().stray_density() <= 0) {
      leaveOut(Pass::Spray, "look.splats.stray_density is 0");
    } else if (!traits_.densities) {
      leaveOut(Pass::Spray, "the source gives no densities");
    } else {
      leaveOut(Pass::Spray, "no particle in the picture is far from the rest");
    }
  }

  const v1::Look& look_;
  const v1::Background& background_;
  const v1::Sun& sun_;
  core::ImageSize size_;
  core::ImageSize surfaceSize_;
  const DataTraits& traits_;
  const ReuseTraits& reuse_;
  FramePlan plan_;
  bool hasShadow_ = false;
};

}  // namespace

FramePlan planFrame(const v1::Scene& scene, core::ImageSize size, const DataTraits& traits, const ReuseTraits& reuse,
                    const DeviceTraits& device) {
  FramePlan plan = Planner(scene, size, traits, reuse, device).plan();
  shareMemory(plan);
  return plan;
}

}  // namespace sluice::render
