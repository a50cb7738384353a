#pragma once

#include <cstdint>

#include "sluice/core/camera.h"
#include "sluice/render/frame_plan.h"
#include "sluice/v1/scene.pb.h"

namespace sluice::render {

/// What is known of the last picture, which tells what of it the next can keep.
class LastPicture {
 public:
  /// Whether a picture of the same particles, `spacing` m apart, would be the same.
  bool shows(double spacing, const v1::Scene& scene, const core::Camera& camera, core::ImageSize size) const;

  /// What the next picture can keep; `bodyChanges` counts those of the bodies until now, see BodyScene.
  ReuseTraits reuse(const v1::Scene& scene, const core::Camera& camera, core::ImageSize size,
                    std::uint64_t bodyChanges) const;

  bool hasLegend() const { return hasLegend_; }

  void note(const FramePlan& plan, double spacing, const v1::Scene& scene, const core::Camera& camera,
            core::ImageSize size, std::uint64_t bodyChanges);

  /// Its buffers are no longer what they were.
  void forget() { hasBackground_ = hasPicture_ = false; }

 private:
  bool sameSurroundings(const v1::Scene& scene) const;

  v1::Scene scene_;  ///< Without its source.
  core::Camera camera_;
  core::ImageSize size_;
  double spacing_ = 0;
  std::uint64_t bodyChanges_ = 0;
  bool hasBackground_ = false;
  bool hasPicture_ = false;
  bool hasLegend_ = false;
};

}  // namespace sluice::render
