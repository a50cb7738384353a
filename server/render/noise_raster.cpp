#include "noise_raster.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sluice::render {

namespace {

/// Rows of a strip: few, because a strip has four numbers for a pixel, which are to stay in the second-level cache.
constexpr int kStripRows = 16;

/// Columns over which a strip knows the nearest and farthest surface.
constexpr int kPatchColumns = 32;

float rowSlope(const ViewGeometry& target, int y) {
  return (static_cast<float>(y) + 0.5F - 0.5F * static_cast<float>(target.size.height)) * target.pixelSlope;
}

PixelBounds boundsOf(const NoiseSprite& sprite, const ViewGeometry& target) {
  const Eigen::Vector2f centre = target.toPixel(Eigen::Vector2f(sprite.x, sprite.y) / sprite.z);
  const float half = sprite.radius / (sprite.z * target.pixelSlope);
  // A pixel's middle stands at a half number.
  const auto low = [](float v, int most) {
    return static_cast<std::int16_t>(std::clamp(std::ceil(v), 0.0F, static_cast<float>(most)));
  };
  return {low(centre.x() - half - 0.5F, target.size.width), low(centre.x() + half + 0.5F, target.size.width),
          low(centre.y() - half - 0.5F, target.size.height), low(centre.y() + half + 0.5F, target.size.height)};
}

/// Depths of the surface in some pixels; those without liquid count for nothing.
struct DepthRange {
  float nearest = kNoLiquid;
  float farthest = 0.0F;

  void add(float z) { add(DepthRange{z, z}); }
  void add(const DepthRange& other) {
    nearest = std::min(nearest, other.nearest);
    farthest = std::max(farthest, other.farthest);
  }
};

/// What a thread keeps of the strip that it draws.
struct Strip {
  explicit Strip(int width, bool withViolence)
      : stride(static_cast<std::size_t>(width) + kNoiseBlock),
        depths(stride * kStripRows),
        height(stride * kStripRows),
        square(stride * kStripRows),
        violence(withViolence ? stride * kStripRows : 0),
        patches((static_cast<std::size_t>(width) + kPatchColumns - 1) / kPatchColumns),
        strip(patches),
        rows(patches * kStripRows) {}

  void begin(std::span<const float> surface, int width, int rowCount) {
    std::ranges::fill(depths, kNoLiquid);
    std::ranges::fill(height, 0.0F);
    std::ranges::fill(square, 0.0F);
    std::ranges::fill(violence, 0.0F);
    std::ranges::fill(strip, DepthRange{});
    std::ranges::fill(rows, DepthRange{});
    for (int y = 0; y < rowCount; ++y) {
      const float* const q = surface.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
      float* const z = depths.data() + stride * static_cast<std::size_t>(y);
      DepthRange* const ranges = rows.data() + patches * static_cast<std::size_t>(y);
      for (int x = 0; x < width; ++x) {
        if (q[x] <= 0.0F) continue;
        z[x] = 1.0F / q[x];
        ranges[x / kPatchColumns].add(z[x]);
      }
      for (std::size_t p = 0; p < patches; ++p) strip[p].add(ranges[p]);
    }
  }

  /// Whether a sprite at depth `z` is within `reach` of any surface in the columns [left, right), and in row y.
  bool mayMeet(int left, int right, float z, float reach) const { return meets(strip.data(), left, right, z, reach); }
  bool mayMeetInRow(int y, int left, int right, float z, float reach) const {
    return meets(rows.data() + patches * static_cast<std::size_t>(y), left, right, z, reach);
  }

  NoiseRow row(int y, int x) {
    const std::size_t at = stride * static_cast<std::size_t>(y) + static_cast<std::size_t>(x);
    return {height.data() + at, square.data() + at, violence.empty() ? nullptr : violence.data() + at};
  }

  std::size_t stride;
  std::vector<float> depths, height, square, violence;
  std::size_t patches;
  std::vector<DepthRange> strip;  ///< Of each patch of columns,
  std::vector<DepthRange> rows;   ///< and of each in each row.

 private:
  static bool meets(const DepthRange* ranges, int left, int right, float z, float reach) {
    for (int p = left / kPatchColumns; p <= (right - 1) / kPatchColumns; ++p) {
      if (z - reach < ranges[p].farthest && z + reach > ranges[p].nearest) return true;
    }
    return false;
  }
};

/// Draws the rows [top, bottom) of a sprite, each no longer than the disc is there.
void drawSprite(const NoiseSprite& sprite, const PixelBounds& box, const ViewGeometry& target, float fallOff,
                const std::vector<float>& columnSlopes, int top, int bottom, Strip& strip) {
  const float middle = target.toPixel(Eigen::Vector2f(sprite.x / sprite.z, 0)).x();
  const float perRow = sprite.z / sprite.radius;
  const float half = sprite.radius / (sprite.z * target.pixelSlope);
  for (int y = std::max<int>(box.top, top); y < std::min<int>(box.bottom, bottom); ++y) {
    const float slopeY = rowSlope(target, y);
    const float beside = slopeY * perRow - sprite.y / sprite.radius;
    const float chord = half * std::sqrt(std::max(1.0F - beside * beside, 0.0F));
    const int left = std::max<int>(box.left, static_cast<int>(std::max(middle - chord - 0.5F, 0.0F)));
    const int right = std::min<int>(box.right, static_cast<int>(std::max(middle + chord + 1.5F, 0.0F)));
    if (left >= right || !strip.mayMeetInRow(y - top, left, right, sprite.z, kNoiseReach * fallOff)) continue;
    const std::size_t at = strip.stride * static_cast<std::size_t>(y - top) + static_cast<std::size_t>(left);
    addNoiseRow(sprite, 1.0F / fallOff, slopeY, columnSlopes.data() + left, strip.depths.data() + at,
                strip.row(y - top, left), right - left);
  }
}

}  // namespace

void NoiseRaster::draw(std::span<const NoiseSprite> sprites, const ViewGeometry& target, float fallOff,
                       std::span<const float> surface, std::span<float> height, std::span<float> violence) {
  const int width = target.size.width;
  columnSlopes_.resize(static_cast<std::size_t>(width) + kNoiseBlock);
  for (std::size_t x = 0; x < columnSlopes_.size(); ++x) {
    columnSlopes_[x] = (static_cast<float>(x) + 0.5F - 0.5F * static_cast<float>(width)) * target.pixelSlope;
  }
  bounds_.resize(sprites.size());
  const auto count = static_cast<std::ptrdiff_t>(sprites.size());
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    bounds_[static_cast<std::size_t>(i)] = boundsOf(sprites[static_cast<std::size_t>(i)], target);
  }
  bins_.fill(bounds_, target.size.height, kStripRows);

  const float reach = kNoiseReach * fallOff;
#pragma omp parallel
  {
    Strip strip(width, !violence.empty());
#pragma omp for schedule(dynamic)
    for (int s = 0; s < bins_.strips(); ++s) {
      const int top = s * kStripRows;
      const int bottom = std::min(top + kStripRows, target.size.height);
      const std::size_t at = static_cast<std::size_t>(top) * static_cast<std::size_t>(width);
      strip.begin(surface.subspan(at), width, bottom - top);
      for (const std::uint32_t index : bins_.met(s)) {
        const NoiseSprite& sprite = sprites[index];
        if (!strip.mayMeet(bounds_[index].left, bounds_[index].right, sprite.z, reach)) continue;
        drawSprite(sprite, bounds_[index], target, fallOff, columnSlopes_, top, bottom, strip);
      }
      for (int y = 0; y < bottom - top; ++y) {
        const std::size_t to = at + static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
        finishNoise(strip.row(y, 0), height.data() + to, width);
        if (!violence.empty()) finishViolence(strip.row(y, 0), violence.data() + to, width);
      }
    }
  }
}

}  // namespace sluice::render
