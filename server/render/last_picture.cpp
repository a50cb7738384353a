#include "last_picture.h"

#include <algorithm>

#include "same.h"

namespace sluice::render {

namespace {

/// What of a scene shows in a picture, besides its particles.
v1::Scene withoutSource(const v1::Scene& scene) {
  v1::Scene rest;
  *rest.mutable_look() = scene.look();
  *rest.mutable_more_looks() = scene.more_looks();
  *rest.mutable_background() = scene.background();
  *rest.mutable_lighting() = scene.lighting();
  *rest.mutable_bodies() = scene.bodies();
  *rest.mutable_tone() = scene.tone();
  *rest.mutable_view() = scene.view();
  if (scene.has_foam()) *rest.mutable_foam() = scene.foam();
  return rest;
}

}  // namespace

bool LastPicture::shows(double spacing, const v1::Scene& scene, const core::Camera& camera,
                        core::ImageSize size) const {
  return hasPicture_ && spacing == spacing_ && camera_ == camera && size_ == size && same(scene_, withoutSource(scene));
}

bool LastPicture::sameSurroundings(const v1::Scene& scene) const {
  return same(scene_.background(), scene.background()) && same(scene_.lighting(), scene.lighting()) &&
         std::ranges::equal(scene_.bodies(), scene.bodies(), same<v1::Body>);
}

ReuseTraits LastPicture::reuse(const v1::Scene& scene, const core::Camera& camera, core::ImageSize size,
                               std::uint64_t bodyChanges) const {
  return {
      hasBackground_ && size_ == size && camera_ == camera && sameSurroundings(scene) && bodyChanges == bodyChanges_,
      hasBackground_ && bodyChanges == bodyChanges_};
}

void LastPicture::note(const FramePlan& plan, double spacing, const v1::Scene& scene, const core::Camera& camera,
                       core::ImageSize size, std::uint64_t bodyChanges) {
  scene_ = withoutSource(scene);
  camera_ = camera;
  spacing_ = spacing;
  bodyChanges_ = bodyChanges;
  hasBackground_ = plan.buffer(Resource::Background) != nullptr;
  hasPicture_ = true;
  hasLegend_ = plan.runs(Pass::Legend);
  size_ = size;
}

}  // namespace sluice::render
