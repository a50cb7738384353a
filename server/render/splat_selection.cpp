#include "splat_selection.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sluice/render/frame_plan.h"

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

  /// Keeps of every tile the nearer of both distances.
  void merge(const TileDistances& other) {
    for (std::size_t i = 0; i < distance_.size(); ++i) distance_[i] = std::min(distance_[i], other.distance_[i]);
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

/// What becomes of a particle.
enum class Fate : std::uint8_t { Outside, Seen, ThicknessOnly, Large, Spray };

/// A particle's splat in space.
struct Body {
  Eigen::Vector3f centre;
  float outer;  ///< Radius of the least ball around it, m.
  float inner;  ///< Radius of the largest ball inside it.
};

Body bodyOf(std::size_t i, const Eigen::Vector3f& position, const SplatModel& model, const SplatLimits& limits) {
  if (model.role(i) == SplatRole::Spray) return {position, limits.dropRadius, limits.dropRadius};
  if (model.shape == SplatShape::Ellipsoid) {
    const SplatEllipsoid& ellipsoid = model.ellipsoids[i];
    // A flat rim reaches √(1 + kRimDepth²) half axes far.
    constexpr float kReach = 1.3F;
    static_assert(kReach * kReach >= 1.0F + kRimDepth * kRimDepth);
    return {ellipsoid.centre, kReach * ellipsoid.longest, ellipsoid.shortest};
  }
  const float radius = model.radius(i, limits.radius);
  return {position, radius, radius};
}

/// A particle as it lies in the picture.
struct Projected {
  Fate fate = Fate::Outside;
  ViewSphere sphere;           ///< Around the splat.
  float inner;                 ///< Radius of the ball inside it, m.
  float frontDistance;         ///< |c| − R.
  Eigen::Vector2f centre;      ///< Of the outline, pixels.
  Eigen::Vector2f halfExtent;  ///< Likewise.
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

Projected project(const Body& body, SplatRole role, const ViewGeometry& view, const SplatLimits& limits,
                  const Eigen::Vector2f& sideLength) {
  Projected result;
  const Eigen::Vector3f centre = view.toView(body.centre);
  result.inner = visibleRadius(body.inner, centre.z(), view.pixelSlope);
  // What widens an ellipsoid's shortest axis widens all of it: see `widened`.
  const float radius = body.outer == body.inner
                           ? result.inner
                           : std::sqrt(body.outer * body.outer + result.inner * result.inner - body.inner * body.inner);
  if (centre.z() + radius <= limits.nearDepth) return result;
  // Outside one of the four side planes of the view.
  if (std::abs(centre.x()) - view.maxSlope.x() * centre.z() > radius * sideLength.x()) return result;
  if (std::abs(centre.y()) - view.maxSlope.y() * centre.z() > radius * sideLength.y()) return result;
  result.sphere = {centre.x(), centre.y(), centre.z(), radius};
  if (role == SplatRole::Spray) {
    if (centre.z() - radius >= limits.nearDepth) result.fate = Fate::Spray;
    return result;
  }
  if (centre.z() - radius < limits.nearDepth) {
    result.fate = Fate::Large;
    return result;
  }
  const SlopeBounds bounds = sphereBounds(centre, radius);
  result.halfExtent = bounds.halfExtent / view.pixelSlope;
  result.centre = view.toPixel(bounds.centre);
  result.frontDistance = centre.norm() - radius;
  if (2.0F * result.halfExtent.maxCoeff() + 1.0F > limits.maxPointPixels) {
    result.fate = Fate::Large;
    return result;
  }
  const Eigen::Vector2f pictureSize(static_cast<float>(view.size.width), static_cast<float>(view.size.height));
  const bool meetsPicture = ((result.centre + result.halfExtent).array() >= 0.0F).all() &&
                            ((result.centre - result.halfExtent).array() <= pictureSize.array()).all();
  if (meetsPicture) result.fate = role == SplatRole::Interior ? Fate::ThicknessOnly : Fate::Seen;
  return result;
}

/// Covers the tiles in which nothing behind a splat can be seen.
void cover(TileDistances& tiles, const Projected& p, SplatShape shape, const ViewGeometry& view) {
  // 0.7 < 1/√2: the square inside the outline, whose least half width is at least R/z.
  const float halfEdge = 0.7F * p.inner / (p.sphere.z * view.pixelSlope);
  const float distance = p.frontDistance + p.sphere.radius;
  const float behind =
      shape == SplatShape::Disc ? distance + p.inner : std::sqrt(distance * distance - p.inner * p.inner);
  tiles.cover(tiles.inside(view.toPixel(Eigen::Vector2f(p.sphere.x, p.sphere.y) / p.sphere.z), halfEdge), behind);
}

}  // namespace

SplatSelection selectSplats(std::span<const Eigen::Vector3f> positions, const SplatModel& model,
                            const ViewGeometry& view, const SplatLimits& limits) {
  const Eigen::Vector2f sideLength = (view.maxSlope.array().square() + 1.0F).sqrt();
  TileDistances tiles(view.size, tileEdge(positions, view, limits.radius));
  std::vector<Projected> projected(positions.size());
  const auto count = static_cast<std::ptrdiff_t>(positions.size());

#pragma omp parallel
  {
    TileDistances mine = tiles;
#pragma omp for schedule(static)
    for (std::ptrdiff_t k = 0; k < count; ++k) {
      const auto i = static_cast<std::size_t>(k);
      Projected& p = projected[i];
      p = project(bodyOf(i, positions[i], model, limits), model.role(i), view, limits, sideLength);
      if (p.fate == Fate::Seen) cover(mine, p, model.shape, view);
    }
#pragma omp critical
    tiles.merge(mine);
  }

  if (limits.leaveOutHidden) {
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t k = 0; k < count; ++k) {
      Projected& p = projected[static_cast<std::size_t>(k)];
      if (p.fate == Fate::Seen && tiles.hides(tiles.meeting(p.centre, p.halfExtent), p.frontDistance)) {
        p.fate = Fate::ThicknessOnly;
      }
    }
  }

  SplatSelection selection;
  selection.nearestDepth = std::numeric_limits<float>::infinity();
  for (std::uint32_t i = 0; i < projected.size(); ++i) {
    const Projected& p = projected[i];
    if (p.fate == Fate::Outside) continue;
    if (p.fate == Fate::Spray) {
      selection.spray.push_back(i);
      continue;
    }
    selection.nearestDepth = std::min(selection.nearestDepth, p.sphere.z - p.sphere.radius);
    if (p.fate == Fate::Large) {
      selection.large.push_back(i);
      continue;
    }
    selection.points.particles.push_back(i);
    if (p.fate == Fate::Seen) selection.visible.particles.push_back(i);
    if (model.role(i) == SplatRole::Interior) ++selection.interiorPoints;
  }
  selection.nearestDepth = std::max(selection.nearestDepth, limits.nearDepth);
  for (SplatList* const list : {&selection.points, &selection.visible}) {
    list->spheres.reserve(list->size());
    for (const std::uint32_t i : list->particles) list->spheres.push_back(projected[i].sphere);
    if (model.shape != SplatShape::Ellipsoid) continue;
    list->ellipsoids.reserve(list->size());
    for (const std::uint32_t i : list->particles) list->ellipsoids.push_back(toView(model.ellipsoids[i], view));
  }
  return selection;
}

}  // namespace sluice::render
