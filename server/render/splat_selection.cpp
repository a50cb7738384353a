#include "splat_selection.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sluice::render {

namespace {

/// The distance behind which a tile of the picture is wholly covered.
class TileDistances {
 public:
  TileDistances(core::ImageSize size, int tile)
      : tile_(tile),
        columns_((size.width + tile - 1) / tile),
        rows_((size.height + tile - 1) / tile),
        distance_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_),
                  std::numeric_limits<float>::infinity()) {}

  struct Range {
    int firstColumn, lastColumn, firstRow, lastRow;
  };

  /// Tiles that meet the rectangle centre ± halfExtent, in pixels.
  Range meeting(const Eigen::Vector2f& centre, const Eigen::Vector2f& halfExtent) const {
    const float scale = 1.0F / static_cast<float>(tile_);
    const auto clampTo = [](float tile, int count) { return static_cast<int>(std::clamp(tile, 0.0F, count - 1.0F)); };
    const Eigen::Vector2f low = (centre - halfExtent) * scale;
    const Eigen::Vector2f high = (centre + halfExtent) * scale;
    return {clampTo(low.x(), columns_), clampTo(high.x(), columns_), clampTo(low.y(), rows_), clampTo(high.y(), rows_)};
  }

  /// Tiles that lie inside the square of half edge `halfEdge`.
  Range inside(const Eigen::Vector2f& centre, float halfEdge) const {
    const float scale = 1.0F / static_cast<float>(tile_);
    const auto clampTo = [](float tile, int low, int high) {
      return static_cast<int>(std::clamp(tile, static_cast<float>(low), static_cast<float>(high)));
    };
    return {clampTo(std::ceil((centre.x() - halfEdge) * scale), 0, columns_),
            clampTo(std::floor((centre.x() + halfEdge) * scale) - 1, -1, columns_ - 1),
            clampTo(std::ceil((centre.y() - halfEdge) * scale), 0, rows_),
            clampTo(std::floor((centre.y() + halfEdge) * scale) - 1, -1, rows_ - 1)};
  }

  void cover(const Range& range, float distance) {
    for (int row = range.firstRow; row <= range.lastRow; ++row) {
      for (int column = range.firstColumn; column <= range.lastColumn; ++column) {
        float& tile = distance_[index(column, row)];
        tile = std::min(tile, distance);
      }
    }
  }

  bool hides(const Range& range, float distance) const {
    for (int row = range.firstRow; row <= range.lastRow; ++row) {
      for (int column = range.firstColumn; column <= range.lastColumn; ++column) {
        if (distance_[index(column, row)] >= distance) return false;
      }
    }
    return true;
  }

 private:
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
  }

  int tile_;
  int columns_;
  int rows_;
  std::vector<float> distance_;
};

/// A point that is in the picture, with what the test for hidden ones needs.
struct Candidate {
  std::uint32_t index;
  float frontDistance;  ///< |c| − R.
  Eigen::Vector2f centre;
  Eigen::Vector2f halfExtent;
};

/// Tiles a little smaller than the square inside a typical outline, so that most spheres cover at least one.
int tileEdge(std::span<const Eigen::Vector3f> positions, const ViewGeometry& view, float radius) {
  // The depth of a few particles spread over the array stands for all of them.
  constexpr std::size_t kSamples = 64;
  const std::size_t stride = std::max<std::size_t>(1, positions.size() / kSamples);
  float sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < positions.size(); i += stride) {
    const float depth = view.toView(positions[i]).z();
    if (depth <= radius) continue;
    sum += radius / (depth * view.pixelSlope);
    ++count;
  }
  const float typicalPixels = count == 0 ? 8.0F : sum / static_cast<float>(count);
  return static_cast<int>(std::clamp(0.6F * typicalPixels, 2.0F, 64.0F));
}

}  // namespace

SplatSelection selectSplats(std::span<const Eigen::Vector3f> positions, const ViewGeometry& view,
                            const SplatLimits& limits) {
  SplatSelection selection;
  selection.nearestDepth = std::numeric_limits<float>::infinity();
  const Eigen::Vector2f pictureSize(static_cast<float>(view.size.width), static_cast<float>(view.size.height));
  const Eigen::Vector2f sideLength = (view.maxSlope.array().square() + 1.0F).sqrt();
  TileDistances tiles(view.size, tileEdge(positions, view, limits.radius));

  std::vector<Candidate> candidates;
  candidates.reserve(positions.size());
  for (std::uint32_t i = 0; i < positions.size(); ++i) {
    const Eigen::Vector3f centre = view.toView(positions[i]);
    const float radius = visibleRadius(limits.radius, centre.z(), view.pixelSlope);
    if (centre.z() + radius <= limits.nearDepth) continue;
    // Outside one of the four side planes of the view.
    if (std::abs(centre.x()) - view.maxSlope.x() * centre.z() > radius * sideLength.x()) continue;
    if (std::abs(centre.y()) - view.maxSlope.y() * centre.z() > radius * sideLength.y()) continue;

    selection.nearestDepth = std::min(selection.nearestDepth, centre.z() - radius);
    if (centre.z() - radius < limits.nearDepth) {
      selection.large.push_back(i);
      continue;
    }
    const SlopeBounds bounds = sphereBounds(centre, radius);
    const Eigen::Vector2f halfExtent = bounds.halfExtent / view.pixelSlope;
    if (2.0F * halfExtent.maxCoeff() + 1.0F > limits.maxPointPixels) {
      selection.large.push_back(i);
      continue;
    }
    const Eigen::Vector2f pixel = view.toPixel(bounds.centre);
    if (((pixel + halfExtent).array() < 0.0F).any() || ((pixel - halfExtent).array() > pictureSize.array()).any()) {
      continue;
    }
    candidates.push_back({i, centre.norm() - radius, pixel, halfExtent});

    // 0.7 < 1/√2: the square inside the outline, whose least half width is at least R/z.
    const float halfEdge = 0.7F * radius / (centre.z() * view.pixelSlope);
    tiles.cover(tiles.inside(pixel, halfEdge), std::sqrt(centre.squaredNorm() - radius * radius));
  }
  selection.nearestDepth = std::max(selection.nearestDepth, limits.nearDepth);

  std::vector<std::uint32_t> hidden;
  for (const Candidate& candidate : candidates) {
    const bool isHidden = limits.leaveOutHidden &&
                          tiles.hides(tiles.meeting(candidate.centre, candidate.halfExtent), candidate.frontDistance);
    (isHidden ? hidden : selection.points).push_back(candidate.index);
  }
  selection.visiblePoints = selection.points.size();
  selection.points.insert(selection.points.end(), hidden.begin(), hidden.end());
  return selection;
}

}  // namespace sluice::render
