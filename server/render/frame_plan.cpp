#include "sluice/render/frame_plan.h"

#include <algorithm>
#include <cmath>

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
    case Pass::Bilateral:
      return "bilateral";
    case Pass::CurvatureFlow:
      return "curvature flow";
    case Pass::ImplicitCurvatureFlow:
      return "implicit curvature flow";
    case Pass::Thickness:
      return "thickness";
    case Pass::LargeThickness:
      return "large thickness";
    case Pass::Composite:
      return "composite";
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
    case Resource::Stencil:
      return "stencil";
    case Resource::Thickness:
      return "thickness";
    case Resource::Picture:
      return "picture";
  }
  return "";
}

std::uint64_t bytesPerPixel(PixelFormat format) { return format == PixelFormat::Stencil8 ? 1 : 4; }

std::uint64_t PictureBuffer::bytes() const {
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
    plan.stages.push_back({std::string(name(step.pass)), names(step.reads), names(step.writes)});
  }
  for (const PictureBuffer& buffer : buffers)
    plan.buffers.push_back({std::string(name(buffer.resource)), buffer.bytes()});
  plan.leftOut = leftOut;
  return plan;
}

FlowSchedule scheduleFlow(const v1::Smoothing& smoothing, const DataTraits& traits, core::ImageSize size) {
  const double footprint = traits.pixelSlope * traits.nearestDepth;
  const double slopeX = 0.5 * traits.pixelSlope * size.width;
  const double slopeY = 0.5 * traits.pixelSlope * size.height;
  const double squaredSlope = slopeX * slopeX + slopeY * slopeY;
  const double sigma = std::sqrt(1 + squaredSlope) * (1 + 0.5 * squaredSlope);
  const double largestStep = footprint * footprint / (2 * sigma);

  const v1::CurvatureFlow& flow = smoothing.curvature_flow();
  FlowSchedule schedule;
  schedule.wantedTime = smoothing.time() * traits.spacing * traits.spacing;
  const double needed = std::ceil(schedule.wantedTime / (flow.step_fraction() * largestStep));
  const auto allowed = static_cast<double>(flow.max_iterations());
  const auto roundUpToEven = [](double n) { return static_cast<int>(2 * std::ceil(n / 2)); };
  if (needed <= allowed) {
    schedule.iterations = roundUpToEven(needed);
    schedule.stepTime = schedule.wantedTime / std::max(1, schedule.iterations);
  } else {
    schedule.iterations = roundUpToEven(allowed);
    schedule.stepTime = flow.step_fraction() * largestStep;
    schedule.shortfall = std::max(0.0, 1 - schedule.iterations * schedule.stepTime / schedule.wantedTime);
  }
  return schedule;
}

namespace {

/// Builds a plan from the top down; one function per part of the frame.
class Planner {
 public:
  Planner(const v1::Look& look, const v1::Background& background, core::ImageSize size, const DataTraits& traits,
          const ReuseTraits& reuse)
      : look_(look), background_(background), size_(size), traits_(traits), reuse_(reuse) {}

  FramePlan plan() {
    planBackground();
    if (traits_.splats() == 0) {
      leaveOut("liquid", "no particle is in the picture");
    } else {
      planSplats();
      planSmoothing();
      planThickness();
      planComposite();
    }
    return std::move(plan_);
  }

 private:
  void run(Pass pass, std::vector<Resource> reads, std::vector<Resource> writes) {
    plan_.steps.push_back({pass, std::move(reads), std::move(writes)});
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
    if (traits_.splats() == 0) return;
    if (!background_.floor()) {
      leaveOut(Pass::GroundShadow, "there is no floor");
    } else if (background_.shadow() <= 0) {
      leaveOut(Pass::GroundShadow, "background.shadow is 0");
    } else {
      hasShadow_ = true;
      allocate(Resource::Scene, PixelFormat::Srgb8Alpha8, size_);
      run(Pass::GroundShadow, {Resource::Particles, Resource::Background}, {Resource::ShadowMap, Resource::Scene});
    }
  }

  void planSplats() {
    allocate(Resource::Surface, PixelFormat::R32f, size_);
    run(Pass::SelectSplats, {Resource::Particles}, {Resource::SplatList});
    if (traits_.points > 0) run(Pass::Splats, {Resource::Particles, Resource::SplatList}, {Resource::Surface});
    if (traits_.hiddenPoints > 0) {
      leaveOut("splats of " + std::to_string(traits_.hiddenPoints) + " particles", "they lie wholly behind others");
    }
    if (traits_.largeSplats > 0) {
      run(Pass::LargeSplats, {Resource::Particles, Resource::SplatList}, {Resource::Surface});
    } else {
      leaveOut(Pass::LargeSplats, "every splat is small enough to be a point");
    }
    allocate(Resource::Stencil, PixelFormat::Stencil8, size_);
    run(Pass::Mask, {Resource::Surface}, {Resource::Stencil});
  }

  void planSmoothing() {
    if (look_.smoothing().time() <= 0) {
      leaveOut("smoothing", "look.smoothing.time is 0");
      return;
    }
    switch (look_.smoothing().method_case()) {
      case v1::Smoothing::kBilateral:
        planFilter(Pass::Bilateral);
        break;
      case v1::Smoothing::kCurvatureFlow:
        plan_.flow = scheduleFlow(look_.smoothing(), traits_, size_);
        planFilter(Pass::CurvatureFlow);
        if (plan_.flow.shortfall > 0) {
          leaveOut("the last " + std::to_string(std::lround(100 * plan_.flow.shortfall)) + " % of the smoothing time",
                   "max_iterations is reached");
        }
        break;
      case v1::Smoothing::kImplicitCurvatureFlow:
        run(Pass::ImplicitCurvatureFlow, {Resource::Surface}, {Resource::Surface});
        break;
      case v1::Smoothing::METHOD_NOT_SET:
        leaveOut("smoothing", "no method is chosen");
        break;
    }
  }

  void planFilter(Pass pass) {
    allocate(Resource::SurfaceScratch, PixelFormat::R32f, size_);
    run(pass, {Resource::Surface, Resource::Stencil}, {Resource::SurfaceScratch, Resource::Surface});
  }

  void planThickness() {
    if (look_.liquid().opaque()) {
      leaveOut(Pass::Thickness, "the liquid is opaque");
      leaveOut("refraction", "the liquid is opaque");
      return;
    }
    const int divisor = static_cast<int>(look_.thickness().divisor());
    const core::ImageSize size{(size_.width + divisor - 1) / divisor, (size_.height + divisor - 1) / divisor};
    allocate(Resource::Thickness, PixelFormat::R32f, size);
    if (traits_.points > 0) run(Pass::Thickness, {Resource::Particles, Resource::SplatList}, {Resource::Thickness});
    if (traits_.largeSplats > 0) {
      run(Pass::LargeThickness, {Resource::Particles, Resource::SplatList}, {Resource::Thickness});
    }
  }

  void planComposite() {
    std::vector<Resource> reads{hasShadow_ ? Resource::Scene : Resource::Background, Resource::Surface,
                                Resource::Stencil};
    if (!look_.liquid().opaque()) reads.push_back(Resource::Thickness);
    if (look_.liquid().specular() <= 0) leaveOut("specular highlight", "look.liquid.specular is 0");
    allocate(Resource::Picture, PixelFormat::Srgb8Alpha8, size_);
    run(Pass::Composite, std::move(reads), {Resource::Picture});
  }

  const v1::Look& look_;
  const v1::Background& background_;
  core::ImageSize size_;
  const DataTraits& traits_;
  const ReuseTraits& reuse_;
  FramePlan plan_;
  bool hasShadow_ = false;
};

}  // namespace

FramePlan planFrame(const v1::Look& look, const v1::Background& background, core::ImageSize size,
                    const DataTraits& traits, const ReuseTraits& reuse) {
  return Planner(look, background, size, traits, reuse).plan();
}

}  // namespace sluice::render
