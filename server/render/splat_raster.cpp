#include "splat_raster.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "simd.h"

namespace sluice::render {

namespace {

/// Rows of a strip: small enough that a strip stays in the second-level cache, large enough that most spheres meet no
/// more than two.
constexpr int kStripRows = 32;

/// Pixels drawn at once; rows are padded by as many.
constexpr int kBlock = 16;

/// What the pixels of one row have in common for one sphere.
struct RowTerms {
  float cx, cy, cz;
  float squaredRadius;
  float rowDiscriminant;  ///< R²(1+W_y²) − e_y².
  float rowCross;         ///< c_x·W_y.
  float rowMiddle;        ///< c_y·W_y + c_z.
};

[[gnu::always_inline]] inline RowTerms rowTerms(const ViewSphere& sphere, float squaredRadius, float slopeY) {
  const float ey = sphere.y - sphere.z * slopeY;
  return {sphere.x,
          sphere.y,
          sphere.z,
          squaredRadius,
          squaredRadius * (1.0F + slopeY * slopeY) - ey * ey,
          sphere.x * slopeY,
          sphere.y * slopeY + sphere.z};
}

[[gnu::always_inline]] inline float discriminant(const RowTerms& row, float slopeX) {
  const float ex = row.cx - row.cz * slopeX;
  const float cross = row.rowCross - row.cy * slopeX;
  return row.rowDiscriminant + row.squaredRadius * slopeX * slopeX - ex * ex - cross * cross;
}

SLUICE_SIMD_CLONES void drawDepthRow(const RowTerms& terms, float inverse, float rim, const float* __restrict slopes,
                                     float* __restrict q, int count) {
  const RowTerms row = terms;
  for (int first = 0; first < count; first += kBlock) {
#pragma GCC ivdep
    for (int i = first; i < first + kBlock; ++i) {
      const float d = discriminant(row, slopes[i]);
      const float root = std::sqrt(std::max(d, 0.0F));
      const float front = (row.rowMiddle + row.cx * slopes[i] + root) * inverse;
      q[i] = std::max(q[i], d >= 0.0F ? std::max(front, rim) : 0.0F);
    }
  }
}

SLUICE_SIMD_CLONES void drawChordRow(const RowTerms& terms, float weight, const float* __restrict slopes,
                                     float* __restrict sum, int count) {
  const RowTerms row = terms;
  for (int first = 0; first < count; first += kBlock) {
#pragma GCC ivdep
    for (int i = first; i < first + kBlock; ++i) {
      sum[i] += weight * std::sqrt(std::max(discriminant(row, slopes[i]), 0.0F));
    }
  }
}

/// (Δz)·√a with Δz = 2√D/a is the length along the line of sight; a = 1+|W|² is the pixel's alone.
SLUICE_SIMD_CLONES void finishChords(const float* __restrict sum, const float* __restrict slopes, float slopeY,
                                     float* __restrict thickness, int count) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    thickness[i] += 2.0F * sum[i] / std::sqrt(1.0F + slopes[i] * slopes[i] + slopeY * slopeY);
  }
}

float rowSlope(const ViewGeometry& target, int y) {
  return (static_cast<float>(y) + 0.5F - 0.5F * static_cast<float>(target.size.height)) * target.pixelSlope;
}

}  // namespace

void SplatRaster::bin(std::span<const ViewSphere> spheres, const ViewGeometry& target) {
  const auto width = static_cast<float>(target.size.width);
  const auto height = static_cast<float>(target.size.height);
  columnSlopes_.resize(static_cast<std::size_t>(target.size.width) + kBlock);
  for (std::size_t x = 0; x < columnSlopes_.size(); ++x) {
    columnSlopes_[x] = (static_cast<float>(x) + 0.5F - 0.5F * width) * target.pixelSlope;
  }

  const auto count = static_cast<std::ptrdiff_t>(spheres.size());
  bounds_.resize(spheres.size());
  spheres_.resize(spheres.size());
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    ViewSphere& sphere = spheres_[static_cast<std::size_t>(i)];
    sphere = spheres[static_cast<std::size_t>(i)];
    sphere.radius = visibleRadius(sphere.radius, sphere.z, target.pixelSlope);
    const SlopeBounds outline = sphereBounds({sphere.x, sphere.y, sphere.z}, sphere.radius);
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

  const auto strips = static_cast<std::size_t>((target.size.height + kStripRows - 1) / kStripRows);
  stripStart_.assign(strips + 1, 0);
  const auto forEachMet = [&](auto&& action) {
    for (std::size_t i = 0; i < bounds_.size(); ++i) {
      const Bounds& box = bounds_[i];
      if (box.left >= box.right || box.top >= box.bottom) continue;
      for (int s = box.top / kStripRows; s <= (box.bottom - 1) / kStripRows; ++s) {
        action(static_cast<std::size_t>(s), static_cast<std::uint32_t>(i));
      }
    }
  };
  forEachMet([&](std::size_t strip, std::uint32_t) { ++stripStart_[strip + 1]; });
  for (std::size_t s = 0; s < strips; ++s) stripStart_[s + 1] += stripStart_[s];
  order_.resize(stripStart_[strips]);
  std::vector<std::uint32_t> next(stripStart_.begin(), stripStart_.end() - 1);
  forEachMet([&](std::size_t strip, std::uint32_t i) { order_[next[strip]++] = i; });
}

template <class DrawStrip>
void SplatRaster::forEachStrip(const ViewGeometry& target, const DrawStrip& drawStrip) {
  const auto strips = static_cast<int>(stripStart_.size()) - 1;
  const std::size_t stride = static_cast<std::size_t>(target.size.width) + kBlock;
#pragma omp parallel
  {
    std::vector<float> pixels(stride * kStripRows);
#pragma omp for schedule(dynamic)
    for (int s = 0; s < strips; ++s) {
      const auto first = stripStart_[static_cast<std::size_t>(s)];
      const auto last = stripStart_[static_cast<std::size_t>(s) + 1];
      if (first == last) continue;
      const int top = s * kStripRows;
      const int bottom = std::min(top + kStripRows, target.size.height);
      std::ranges::fill(pixels, 0.0F);
      const auto row = [&](int y) { return pixels.data() + stride * static_cast<std::size_t>(y - top); };
      drawStrip(std::span(order_).subspan(first, last - first), top, bottom, row);
    }
  }
}

void SplatRaster::drawDepth(std::span<const ViewSphere> spheres, const ViewGeometry& target, float rimDepth,
                            std::span<float> q) {
  bin(spheres, target);
  const auto width = static_cast<std::size_t>(target.size.width);
  forEachStrip(target, [&](std::span<const std::uint32_t> met, int top, int bottom, const auto& row) {
    for (const std::uint32_t index : met) {
      const ViewSphere& sphere = spheres_[index];
      const Bounds& box = bounds_[index];
      const float squaredRadius = sphere.radius * sphere.radius;
      const float inverse = 1.0F / (sphere.x * sphere.x + sphere.y * sphere.y + sphere.z * sphere.z - squaredRadius);
      const float rim = 1.0F / (sphere.z - rimDepth * sphere.radius) * (rimDepth > 0.0F ? 1.0F : 0.0F);
      for (int y = std::max<int>(box.top, top); y < std::min<int>(box.bottom, bottom); ++y) {
        drawDepthRow(rowTerms(sphere, squaredRadius, rowSlope(target, y)), inverse, rim,
                     columnSlopes_.data() + box.left, row(y) + box.left, box.right - box.left);
      }
    }
    for (int y = top; y < bottom; ++y) {
      float* const pixels = q.data() + width * static_cast<std::size_t>(y);
      const float* const drawn = row(y);
      for (std::size_t x = 0; x < width; ++x) pixels[x] = std::max(pixels[x], drawn[x]);
    }
  });
}

void SplatRaster::drawThickness(std::span<const ViewSphere> spheres, const ViewGeometry& target, float particleVolume,
                                std::span<float> thickness) {
  bin(spheres, target);
  const auto width = static_cast<std::size_t>(target.size.width);
  forEachStrip(target, [&](std::span<const std::uint32_t> met, int top, int bottom, const auto& row) {
    for (const std::uint32_t index : met) {
      const ViewSphere& sphere = spheres_[index];
      const Bounds& box = bounds_[index];
      const float squaredRadius = sphere.radius * sphere.radius;
      const float sphereVolume = 4.0F / 3.0F * std::numbers::pi_v<float> * squaredRadius * sphere.radius;
      const float weight = particleVolume / sphereVolume;
      for (int y = std::max<int>(box.top, top); y < std::min<int>(box.bottom, bottom); ++y) {
        drawChordRow(rowTerms(sphere, squaredRadius, rowSlope(target, y)), weight, columnSlopes_.data() + box.left,
                     row(y) + box.left, box.right - box.left);
      }
    }
    for (int y = top; y < bottom; ++y) {
      finishChords(row(y), columnSlopes_.data(), rowSlope(target, y),
                   thickness.data() + width * static_cast<std::size_t>(y), target.size.width);
    }
  });
}

}  // namespace sluice::render
