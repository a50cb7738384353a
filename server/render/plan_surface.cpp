#include <algorithm>
#include <iterator>
#include <span>

#include "composite_variant.h"
#include "interior_particles.h"
#include "planner.h"
#include "smoothing/smoothing_method.h"

namespace sluice::render {

void Planner::planSurface() {
  planSplats();
  planSmoothing();
  planThickness();
  if (!isStudy(scene_.view())) planBackSurface();
  if (!isStudy(scene_.view()) || scene_.view().has_noise()) planNoise();
}

void Planner::planSplats() {
  const v1::Splats& splats = look().splats();
  if (splats.radius_by_density() && !traits().densities) {
    leaveOut("radius by density", "the source gives no densities");
  }
  if (!splats.skip_interior()) {
    leaveOut("search for interior particles", "look.splats.skip_interior is off");
  } else if (!traits().neighbourCounts) {
    // Densities do not tell: next to a wall they are as high as inside, and the liquid there is seen through it.
    leaveOut("search for interior particles", "the source gives no numbers of neighbours");
  } else if (splats.radius_in_spacings() < kLeastRadiusOfInterior) {
    leaveOut("search for interior particles", "small splats leave gaps through which they are seen");
  }
  allocate(Resource::Surface, PixelFormat::R32f, surfaceSize());
  run(Pass::SelectSplats, {Resource::Particles}, {Resource::SplatList});
  if (traits().points > 0) run(Pass::Splats, {Resource::Particles, Resource::SplatList}, {Resource::Surface});
  if (traits().interiorPoints > 0) {
    leaveOut("splats of " + std::to_string(traits().interiorPoints) + " particles", "they are deep inside the liquid");
  }
  if (traits().hiddenPoints > traits().interiorPoints) {
    leaveOut("splats of " + std::to_string(traits().hiddenPoints - traits().interiorPoints) + " particles",
             "they lie wholly behind others");
  }
  if (traits().largeSplats > 0) {
    run(Pass::LargeSplats, {Resource::Particles, Resource::SplatList}, {Resource::Surface});
  } else {
    leaveOut(Pass::LargeSplats, "every splat is small enough to be a point");
  }
  allocate(Resource::Stencil, PixelFormat::Stencil8, surfaceSize());
}

void Planner::planMask() {
  std::vector<Resource> reads{Resource::Surface};
  if (hasBodies()) reads.push_back(Resource::SceneDepth);
  run(Pass::Mask, reads, {Resource::Stencil});
}

void Planner::planSmoothing() {
  const v1::Smoothing& smoothing = look().smoothing();
  const v1::View& view = scene_.view();
  if (view.has_raw_depth() || view.has_spheres() || view.has_points()) {
    leaveOut("smoothing", "the view shows the splats as they are");
    planMask();
    return;
  }
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
  surface.spacing = traits().spacing;
  surface.splatRadius = look().splats().radius_in_spacings() * traits().spacing;
  surface.nearestDepth = traits().nearestDepth;
  surface.pixelSlope = traits().pixelSlope * smoothing.divisor();
  surface.size = surfaceSize();
  surface.device = plan_.device;
  SmoothingPlan needs = method->plan(smoothing, surface);

  std::vector<Resource> reads{Resource::Surface};
  std::vector<Resource> writes{Resource::Surface};
  if (needs.mask) {
    planMask();
    reads.push_back(Resource::Stencil);
  }
  for (const Resource scratch : std::span(kSurfaceScratch).first(needs.scratch)) {
    allocate(scratch, PixelFormat::R32f, surfaceSize());
    writes.push_back(scratch);
  }
  plan_.surfaces[liquid_].flow = needs.flow;
  plan_.surfaces[liquid_].flatRims = needs.flatRims;
  std::ranges::move(needs.leftOut, std::back_inserter(plan_.leftOut));
  run(Pass::Smoothing, smoothingName(smoothing.method_case()), reads, writes, needs.sweeps);
  if (!needs.mask || needs.erodes) planMask();
}

void Planner::planThickness() {
  if (isStudy(scene_.view()) && !scene_.view().has_thickness()) {
    leaveOut(Pass::Thickness, "the view does not show it");
    return;
  }
  if (isOpaque(look().liquid()) && !scene_.view().has_thickness()) {
    const char* const reason = look().liquid().has_metal() ? "the liquid is a metal" : "the liquid is opaque";
    leaveOut(Pass::Thickness, reason);
    leaveOut("refraction", reason);
    return;
  }
  allocate(Resource::Thickness, PixelFormat::R32f, thicknessSize());
  if (traits().points > 0) run(Pass::Thickness, {Resource::Particles, Resource::SplatList}, {Resource::Thickness});
  if (traits().largeSplats > 0) {
    run(Pass::LargeThickness, {Resource::Particles, Resource::SplatList}, {Resource::Thickness});
  }
  if (look().thickness().smoothing_in_spacings() > 0) {
    std::vector<Resource> writes{Resource::Thickness};
    if (!plan_.device.software) {
      allocate(Resource::ThicknessScratch, PixelFormat::R32f, thicknessSize());
      writes.push_back(Resource::ThicknessScratch);
    }
    run(Pass::SmoothThickness, {Resource::Thickness, Resource::Surface}, writes);
  } else {
    leaveOut(Pass::SmoothThickness, "look.thickness.smoothing_in_spacings is 0");
  }
  if (hasBodies() && !isStudy(scene_.view()))
    run(Pass::ClipThickness, {Resource::Surface, Resource::SceneDepth}, {Resource::Thickness});
}

}  // namespace sluice::render
