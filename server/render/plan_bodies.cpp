#include <algorithm>

#include "composite_variant.h"
#include "planner.h"
#include "scene_lights.h"

namespace sluice::render {

bool Planner::hasBodies() const { return hasMatteBodies(scene_); }

bool Planner::hasGlass() const {
  return std::ranges::any_of(scene_.bodies(), [](const v1::Body& body) { return body.has_glass(); });
}

void Planner::planBodyShadow() {
  const v1::Sun& sun = scene_.lighting().sun();
  if (!hasBodies()) {
    leaveOut(Pass::BodyShadow, "nothing but glass and liquid stands in the scene");
  } else if (sun.strength() <= 0 || sun.shadow() <= 0) {
    leaveOut(Pass::BodyShadow, sun.strength() <= 0 ? "lighting.sun.strength is 0" : "lighting.sun.shadow is 0");
  } else {
    allocate(Resource::BodyShadowMap, PixelFormat::R32f, {kBodyShadowEdge, kBodyShadowEdge});
    if (reuse_.bodies) {
      leaveOut(Pass::BodyShadow, "bodies and sun are those of the last frame");
    } else {
      run(Pass::BodyShadow, {}, {Resource::BodyShadowMap});
    }
  }
}

void Planner::planBodies() {
  if (!hasBodies()) {
    leaveOut(Pass::Bodies, "nothing but glass and liquid stands in the scene");
    return;
  }
  allocate(Resource::SceneDepth, PixelFormat::R32f, size_);
  allocate(Resource::BodySamples, PixelFormat::Rgba16fDepth32fTimes4, size_);
  if (reuse_.background) {
    leaveOut(Pass::Bodies, "camera, size and bodies are those of the last frame");
  } else {
    run(Pass::Bodies, {Resource::BodyShadowMap}, {Resource::BodySamples, Resource::Background, Resource::SceneDepth});
  }
}

void Planner::planGlassBehind() {
  if (!hasGlass()) {
    leaveOut(Pass::GlassBehind, "no body is of glass");
    leaveOut(Pass::GlassBefore, "no body is of glass");
    return;
  }
  std::vector<Resource> reads{sceneUnderLiquid()};
  if (liquidsWithSplats() > 0) reads.push_back(Resource::Surface);
  if (hasBodies()) reads.push_back(Resource::SceneDepth);
  hasScene_ = true;
  allocate(Resource::Scene, PixelFormat::Rgba16f, size_);
  run(Pass::GlassBehind, reads, {Resource::Scene});
}

void Planner::planGlassBefore() {
  if (!hasGlass()) return;
  beginPicture();
  std::vector<Resource> reads;
  if (liquidsWithSplats() > 0) reads.push_back(Resource::Surface);
  if (hasBodies()) reads.push_back(Resource::SceneDepth);
  run(Pass::GlassBefore, reads, {Resource::Picture});
}

void Planner::planBodyEdges() {
  if (!hasBodies() || liquidsWithSplats() == 0) return;
  run(Pass::BodyEdges, {Resource::BodySamples, Resource::Surface}, {Resource::Picture});
}

}  // namespace sluice::render
