#include "picture_cover.h"

namespace sluice::render {

void PictureCover::add(const Eigen::Vector3f& point) {
  const Eigen::Vector3f at = view_.toView(point);
  constexpr float kNear = 0.01F;  // m
  if (at.z() < kNear) isWhole_ = true;
  if (!isWhole_) bounds_.extend(view_.toPixel(at.head<2>() / at.z()));
}

void PictureCover::add(const Eigen::AlignedBox3f& box, const Eigen::Isometry3f& pose) {
  for (int corner = 0; corner < 8; ++corner) {
    add(pose * box.corner(static_cast<Eigen::AlignedBox3f::CornerType>(corner)));
  }
}

PixelRect PictureCover::pixels() const {
  if (isWhole_) return {0, 0, view_.size.width, view_.size.height};
  if (bounds_.isEmpty()) return {};
  const auto whole = Eigen::Array2f(static_cast<float>(view_.size.width), static_cast<float>(view_.size.height));
  const Eigen::Array2i low = (bounds_.min().array() - 1).floor().max(0).min(whole).cast<int>();
  const Eigen::Array2i high = (bounds_.max().array() + 1).ceil().max(0).min(whole).cast<int>();
  return {low.x(), low.y(), high.x() - low.x(), high.y() - low.y()};
}

}  // namespace sluice::render
