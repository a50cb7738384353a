#include "attribute_raster.h"

#include <algorithm>
#include <cmath>

#include "sluice/core/simd.h"

namespace sluice::render {

namespace {

/// Pixels drawn at once; rows are padded by as many.
constexpr int kBlock = 16;
/// As in SplatRaster.
constexpr int kStripRows = 32;
/// Eye depth where there is no surface, m: beyond all that a particle reaches, and its square is finite.
constexpr float kNowhere = 1e12F;

float rowSlope(const ViewGeometry& target, int y) {
  return (static_cast<float>(y) + 0.5F - 0.5F * static_cast<float>(target.size.height)) * target.pixelSlope;
}

/// A particle's reach, at least so much that it meets the middles of the pixels around it: far liquid has values too.
float reachAt(float depth, float reach, float pixelSlope) {
  return std::max(reach, kValueLeastPixels * pixelSlope * depth);
}

/// What one particle adds along a row of `count` pixels, and up to a block beyond, where its weight is 0.
SLUICE_SIMD_CLONES void addRow(const ViewValue& particle, float acrossPerSquare, float alongPerSquare, float slopeY,
                               const float* __restrict slopes, const float* __restrict depths, float* __restrict sum,
                               float* __restrict weights, int count) {
  const float ey = particle.y - particle.z * slopeY;
  const float room = 1.0F - acrossPerSquare * ey * ey;
  const float cx = particle.x;
  const float cz = particle.z;
  const float value = particle.value;
  for (int first = 0; first < count; first += kBlock) {
#pragma GCC ivdep
    for (int i = first; i < first + kBlock; ++i) {
      const float ex = cx - cz * slopes[i];
      const float across = std::max(room - acrossPerSquare * ex * ex, 0.0F);
      const float delta = cz - depths[i];
      const float along = std::max(1.0F - alongPerSquare * delta * delta, 0.0F);
      const float weight = across * across * (kValueEverywhere + along * along);
      sum[i] += weight * value;
      weights[i] += weight;
    }
  }
}

SLUICE_SIMD_CLONES void divideRow(const float* __restrict sum, const float* __restrict weights,
                                  float* __restrict result, int count) {
  // The least positive normal number: 0 for pixels that nothing reaches.
  constexpr float kLeast = 1.1754944e-38F;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) result[i] = sum[i] / std::max(weights[i], kLeast);
}

}  // namespace

void AttributeRaster::bin(std::span<const ViewValue> particles, float reach, const ViewGeometry& target) {
  const auto width = static_cast<float>(target.size.width);
  const auto height = static_cast<float>(target.size.height);
  columnSlopes_.resize(static_cast<std::size_t>(target.size.width) + kBlock);
  for (std::size_t x = 0; x < columnSlopes_.size(); ++x) {
    columnSlopes_[x] = (static_cast<float>(x) + 0.5F - 0.5F * width) * target.pixelSlope;
  }
  const auto count = static_cast<std::ptrdiff_t>(particles.size());
  bounds_.resize(particles.size());
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const ViewValue& particle = particles[static_cast<std::size_t>(i)];
    const Eigen::Vector2f centre = target.toPixel(Eigen::Vector2f(particle.x, particle.y) / particle.z);
    const float half = reachAt(particle.z, reach, target.pixelSlope) / (particle.z * target.pixelSlope);
    // A pixel's middle stands at a half number.
    const auto low = [](float v, float most) {
      return static_cast<std::int16_t>(std::clamp(std::ceil(v), 0.0F, most));
    };
    bounds_[static_cast<std::size_t>(i)] = {low(centre.x() - half - 0.5F, width), low(centre.x() + half + 0.5F, width),
                                            low(centre.y() - half - 0.5F, height),
                                            low(centre.y() + half + 0.5F, height)};
  }
  bins_.fill(bounds_, target.size.height, kStripRows);
}

void AttributeRaster::readDepths(std::span<const float> q, const ViewGeometry& surfaceView,
                                 const ViewGeometry& target) {
  const int width = target.size.width;
  const int height = target.size.height;
  const std::size_t stride = static_cast<std::size_t>(width) + kBlock;
  depths_.resize(stride * static_cast<std::size_t>(height));
  const float ratio = target.pixelSlope / surfaceView.pixelSlope;
  const auto nearest = [&](int i, int count, int surfaceCount) {
    const float place = (static_cast<float>(i) + 0.5F - 0.5F * static_cast<float>(count)) * ratio +
                        0.5F * static_cast<float>(surfaceCount);
    return std::clamp(static_cast<int>(std::floor(place)), 0, surfaceCount - 1);
  };
  std::vector<int> columns(static_cast<std::size_t>(width));
  for (int x = 0; x < width; ++x) columns[static_cast<std::size_t>(x)] = nearest(x, width, surfaceView.size.width);
#pragma omp parallel for schedule(static)
  for (int y = 0; y < height; ++y) {
    const float* const row =
        q.data() + static_cast<std::ptrdiff_t>(nearest(y, height, surfaceView.size.height)) * surfaceView.size.width;
    float* const depths = depths_.data() + stride * static_cast<std::size_t>(y);
    for (int x = 0; x < width; ++x) {
      const float inverse = row[columns[static_cast<std::size_t>(x)]];
      depths[x] = inverse > 0.0F ? 1.0F / inverse : kNowhere;
    }
    std::fill_n(depths + width, kBlock, kNowhere);
  }
}

void AttributeRaster::draw(std::span<const ViewValue> particles, float radius, std::span<const float> q,
                           const ViewGeometry& surfaceView, const ViewGeometry& target, std::span<float> result) {
  const float reach = kValueReach * radius;
  bin(particles, reach, target);
  readDepths(q, surfaceView, target);
  const float alongPerSquare = 1.0F / (kValueDepthReach * radius * kValueDepthReach * radius);
  const int width = target.size.width;
  const std::size_t stride = static_cast<std::size_t>(width) + kBlock;
#pragma omp parallel
  {
    std::vector<float> sums(stride * kStripRows);
    std::vector<float> weights(stride * kStripRows);
#pragma omp for schedule(dynamic)
    for (int s = 0; s < bins_.strips(); ++s) {
      const int top = s * kStripRows;
      const int bottom = std::min(top + kStripRows, target.size.height);
      std::ranges::fill(sums, 0.0F);
      std::ranges::fill(weights, 0.0F);
      const auto place = [&](int y) { return stride * static_cast<std::size_t>(y - top); };
      for (const std::uint32_t index : bins_.met(s)) {
        const PixelBounds& box = bounds_[index];
        const ViewValue& particle = particles[index];
        const float across = reachAt(particle.z, reach, target.pixelSlope);
        for (int y = std::max<int>(box.top, top); y < std::min<int>(box.bottom, bottom); ++y) {
          const std::size_t first = place(y) + static_cast<std::size_t>(box.left);
          addRow(particle, 1.0F / (across * across), alongPerSquare, rowSlope(target, y),
                 columnSlopes_.data() + box.left,
                 depths_.data() + stride * static_cast<std::size_t>(y) + static_cast<std::size_t>(box.left),
                 sums.data() + first, weights.data() + first, box.right - box.left);
        }
      }
      for (int y = top; y < bottom; ++y) {
        divideRow(sums.data() + place(y), weights.data() + place(y),
                  result.data() + static_cast<std::ptrdiff_t>(y) * width, width);
      }
    }
  }
}

}  // namespace sluice::render
