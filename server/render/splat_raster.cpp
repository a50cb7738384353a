#include "splat_raster.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "splat_rows.h"

namespace sluice::render {

namespace {

/// Rows of a strip: small enough that a strip stays in the second-level cache, large enough that most splats meet no
/// more than two.
constexpr int kStripRows = 32;

float rowSlope(const ViewGeometry& target, int y) {
  return (static_cast<float>(y) + 0.5F - 0.5F * static_cast<float>(target.size.height)) * target.pixelSlope;
}

float ballVolume(float radius) { return 4.0F / 3.0F * std::numbers::pi_v<float> * radius * radius * radius; }

}  // namespace

template <class Splat>
void SplatRaster::bin(std::span<const Splat> splats, const ViewGeometry& target) {
  const auto width = static_cast<float>(target.size.width);
  const auto height = static_cast<float>(target.size.height);
  columnSlopes_.resize(static_cast<std::size_t>(target.size.width) + kSplatBlock);
  for (std::size_t x = 0; x < columnSlopes_.size(); ++x) {
    columnSlopes_[x] = (static_cast<float>(x) + 0.5F - 0.5F * width) * target.pixelSlope;
  }

  const auto count = static_cast<std::ptrdiff_t>(splats.size());
  bounds_.resize(splats.size());
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const SlopeBounds outline = boundsOf(widened(splats[static_cast<std::size_t>(i)], target.pixelSlope));
    const Eigen::Vector2f centre = target.toPixel(outline.centre);
    const Eigen::Vector2f half = outline.halfExtent / target.pixelSlope;
    // A pixel's middle stands at a half number.
    const auto low = [](float v, float most) {
      return static_cast<std::int16_t>(std::clamp(std::ceil(v), 0.0F, most));
    };
    bounds_[static_cast<std::size_t>(i)] = {
        low(centre.x() - half.x() - 0.5F, width), low(centre.x() + half.x() + 0.5F, width),
        low(centre.y() - half.y() - 0.5F, height), low(centre.y() + half.y() + 0.5F, height)};
  }

  bins_.fill(bounds_, target.size.height, kStripRows);
}

/// Calls `drawStrip(splats met, first row, last row, row)` for each strip, where `row(y)` is its own memory of zeros.
template <class DrawStrip>
void SplatRaster::forEachStrip(const ViewGeometry& target, float empty, const DrawStrip& drawStrip) {
  const std::size_t stride = static_cast<std::size_t>(target.size.width) + kSplatBlock;
#pragma omp parallel
  {
    std::vector<float> pixels(stride * kStripRows);
#pragma omp for schedule(dynamic)
    for (int s = 0; s < bins_.strips(); ++s) {
      if (bins_.met(s).empty()) continue;
      const int top = s * kStripRows;
      const int bottom = std::min(top + kStripRows, target.size.height);
      std::ranges::fill(pixels, empty);
      const auto row = [&](int y) { return pixels.data() + stride * static_cast<std::size_t>(y - top); };
      drawStrip(bins_.met(s), top, bottom, row);
    }
  }
}

/// `drawRows(widened splat, rows)` draws one splat, where `rows(action)` calls `action(slope of the row, slopes,
/// pixels, count)` for every row of it, in pixels that start as `empty`; `finishRow(y, pixels)` then puts a row drawn
/// by all of them into the picture.
template <class Splat, class DrawRows, class FinishRow>
void SplatRaster::draw(std::span<const Splat> splats, const ViewGeometry& target, float empty, const DrawRows& drawRows,
                       const FinishRow& finishRow) {
  bin(splats, target);
  forEachStrip(target, empty, [&](std::span<const std::uint32_t> met, int top, int bottom, const auto& row) {
    for (const std::uint32_t index : met) {
      const PixelBounds& box = bounds_[index];
      drawRows(widened(splats[index], target.pixelSlope), [&](const auto& drawRow) {
        for (int y = std::max<int>(box.top, top); y < std::min<int>(box.bottom, bottom); ++y) {
          drawRow(rowSlope(target, y), columnSlopes_.data() + box.left, row(y) + box.left, box.right - box.left);
        }
      });
    }
    for (int y = top; y < bottom; ++y) finishRow(y, row(y));
  });
}

template <class Splat, class DrawRows>
void SplatRaster::drawFronts(std::span<const Splat> splats, const ViewGeometry& target, std::span<float> q,
                             const DrawRows& drawRows) {
  const auto width = static_cast<std::size_t>(target.size.width);
  draw(splats, target, 0.0F, drawRows, [&](int y, const float* drawn) {
    float* const pixels = q.data() + width * static_cast<std::size_t>(y);
    for (std::size_t x = 0; x < width; ++x) pixels[x] = std::max(pixels[x], drawn[x]);
  });
}

template <class Splat, class DrawRows>
void SplatRaster::drawBacks(std::span<const Splat> splats, const ViewGeometry& target, std::span<float> z,
                            const DrawRows& drawRows) {
  const auto width = static_cast<std::size_t>(target.size.width);
  // A pixel without splats is endlessly near, at inverse depth ∞, and so at depth 0 in the end.
  draw(splats, target, std::numeric_limits<float>::infinity(), drawRows, [&](int y, const float* drawn) {
    float* const pixels = z.data() + width * static_cast<std::size_t>(y);
    for (std::size_t x = 0; x < width; ++x) pixels[x] = std::max(pixels[x], 1.0F / drawn[x]);
  });
}

template <class Splat, class DrawRows>
void SplatRaster::drawChords(std::span<const Splat> splats, const ViewGeometry& target, std::span<float> thickness,
                             const DrawRows& drawRows) {
  const auto width = static_cast<std::size_t>(target.size.width);
  draw(splats, target, 0.0F, drawRows, [&](int y, const float* sum) {
    finishChords(sum, columnSlopes_.data(), rowSlope(target, y), thickness.data() + width * static_cast<std::size_t>(y),
                 target.size.width);
  });
}

void SplatRaster::drawDepth(std::span<const ViewSphere> spheres, const ViewGeometry& target, float rimDepth,
                            std::span<float> q) {
  drawFronts(spheres, target, q, [&](const ViewSphere& sphere, const auto& rows) {
    const float rim = rimOf(sphere, rimDepth);
    rows([&](float slopeY, const float* slopes, float* pixels, int count) {
      drawDepthRow(sphere, rim, slopeY, slopes, pixels, count);
    });
  });
}

void SplatRaster::drawDiscDepth(std::span<const ViewSphere> spheres, const ViewGeometry& target, std::span<float> q) {
  drawFronts(spheres, target, q, [](const ViewSphere& sphere, const auto& rows) {
    rows([&](float slopeY, const float* slopes, float* pixels, int count) {
      drawDiscRow(sphere, slopeY, slopes, pixels, count);
    });
  });
}

void SplatRaster::drawDepth(std::span<const ViewEllipsoid> ellipsoids, const ViewGeometry& target, float rimDepth,
                            std::span<float> q) {
  drawFronts(ellipsoids, target, q, [&](const ViewEllipsoid& ellipsoid, const auto& rows) {
    const EllipsoidRays rays(ellipsoid);
    const float rim = rimOf(rays, rimDepth);
    rows([&](float slopeY, const float* slopes, float* pixels, int count) {
      drawDepthRow(rays, ellipsoid, rim, slopeY, slopes, pixels, count);
    });
  });
}

void SplatRaster::drawBackDepth(std::span<const ViewSphere> spheres, const ViewGeometry& target, float rimDepth,
                                std::span<float> z) {
  drawBacks(spheres, target, z, [&](const ViewSphere& sphere, const auto& rows) {
    const float rim = backRimOf(sphere, rimDepth);
    rows([&](float slopeY, const float* slopes, float* pixels, int count) {
      drawBackRow(sphere, rim, slopeY, slopes, pixels, count);
    });
  });
}

void SplatRaster::drawBackDepth(std::span<const ViewEllipsoid> ellipsoids, const ViewGeometry& target, float rimDepth,
                                std::span<float> z) {
  drawBacks(ellipsoids, target, z, [&](const ViewEllipsoid& ellipsoid, const auto& rows) {
    const EllipsoidRays rays(ellipsoid);
    const float rim = backRimOf(rays, rimDepth);
    rows([&](float slopeY, const float* slopes, float* pixels, int count) {
      drawBackRow(rays, ellipsoid, rim, slopeY, slopes, pixels, count);
    });
  });
}

void SplatRaster::drawDiscBackDepth(std::span<const ViewSphere> spheres, const ViewGeometry& target,
                                    std::span<float> z) {
  drawBacks(spheres, target, z, [](const ViewSphere& sphere, const auto& rows) {
    rows([&](float slopeY, const float* slopes, float* pixels, int count) {
      drawDiscBackRow(sphere, slopeY, slopes, pixels, count);
    });
  });
}

void SplatRaster::drawThickness(std::span<const ViewSphere> spheres, const ViewGeometry& target, float particleVolume,
                                std::span<float> thickness) {
  drawChords(spheres, target, thickness, [&](const ViewSphere& sphere, const auto& rows) {
    const float weight = particleVolume / ballVolume(sphere.radius);
    rows([&](float slopeY, const float* slopes, float* pixels, int count) {
      drawChordRow(sphere, weight, slopeY, slopes, pixels, count);
    });
  });
}

void SplatRaster::drawThickness(std::span<const ViewEllipsoid> ellipsoids, const ViewGeometry& target,
                                float particleVolume, std::span<float> thickness) {
  drawChords(ellipsoids, target, thickness, [&](const ViewEllipsoid& ellipsoid, const auto& rows) {
    const EllipsoidRays rays(ellipsoid);
    const float weight = particleVolume / rays.volume;
    rows([&](float slopeY, const float* slopes, float* pixels, int count) {
      drawChordRow(rays, ellipsoid, weight, slopeY, slopes, pixels, count);
    });
  });
}

}  // namespace sluice::render
