#pragma once

#include <Eigen/Geometry>

#include "pixel_rects.h"
#include "view_geometry.h"

namespace sluice::render {

/// Grows to a rectangle of a picture that holds points of the scene: the whole picture where one is behind the eye.
class PictureCover {
 public:
  explicit PictureCover(const ViewGeometry& view) : view_(view) {}

  void add(const Eigen::Vector3f& point);
  /// A box, where `pose` puts it.
  void add(const Eigen::AlignedBox3f& box, const Eigen::Isometry3f& pose = Eigen::Isometry3f::Identity());

  /// With a pixel around; empty where nothing is in the picture.
  PixelRect pixels() const;

 private:
  const ViewGeometry& view_;
  Eigen::AlignedBox2f bounds_;
  bool isWhole_ = false;
};

}  // namespace sluice::render
