#include "foam_dots.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "frame_uniforms.h"

namespace sluice::render {

namespace {

using core::DiffuseKind;
using Eigen::Vector2f;
using Eigen::Vector3f;

/// How one kind looks.
struct KindLook {
  float leastSize;  ///< Of the scene's radius,
  float mostSize;   ///< spread evenly, so that no two specks are alike.
  float opacity;    ///< Of the scene's.
};

KindLook lookOf(DiffuseKind kind) {
  switch (kind) {
    case DiffuseKind::Spray:  // tiny specks, each by itself
      return {0.3F, 0.8F, 1.6F};
    case DiffuseKind::Foam:
      return {0.5F, 1.4F, 1.0F};
    case DiffuseKind::Bubble:  // mostly looked through
      return {0.4F, 0.9F, 0.5F};
  }
  return {};
}

/// The last share of its life in which foam thins out.
constexpr float kThinning = 0.4F;

/// An opaque dot hides all but this.
constexpr float kLeastSeenThrough = 0.01F;

/// Smallest dot, pixels: a soft one that is smaller flickers as it moves from pixel to pixel.
constexpr float kLeastPixels = 1.25F;

/// A number in [0, 1) that a particle keeps.
float shareOf(std::uint32_t id) {
  // Knuth's multiplicative hash, 2³²/φ.
  return static_cast<float>((id * 2654435769U) >> 8) * 0x1p-24F;
}

/// Rows that one thread draws at a time: they stay in its cache.
constexpr int kStripRows = 32;

/// A dot in the picture.
struct Disc {
  float x, y;    ///< Pixels.
  float radius;  ///< Pixels.
  float opacity;
};

/// The value of a picture at the pixel that a line of sight meets, or the nearest one.
float valueAt(std::span<const float> values, const ViewGeometry& view, const Vector2f& slope) {
  const Vector2f pixel = view.toPixel(slope);
  const int x = std::clamp(static_cast<int>(pixel.x()), 0, view.size.width - 1);
  const int y = std::clamp(static_cast<int>(pixel.y()), 0, view.size.height - 1);
  return values[static_cast<std::size_t>(y) * static_cast<std::size_t>(view.size.width) + static_cast<std::size_t>(x)];
}

/// What lies on a body is seen, though its middle may be a little inside.
constexpr float kHidden = 1.01F;

Disc discOf(const FoamDot& dot, const ViewGeometry& view, const FoamCovers& covers) {
  const Vector2f slope(dot.x / dot.z, dot.y / dot.z);
  if (!covers.sceneDepth.empty() && valueAt(covers.sceneDepth, view, slope) * dot.z > kHidden) return {};
  float nearest = 0;
  for (const FoamCover& liquid : covers.liquids) {
    nearest = std::max(nearest, valueAt(liquid.inverseDepth, liquid.view, slope));
  }
  const float below = nearest > 0 ? std::max(0.0F, dot.z - 1 / nearest - covers.bed) : 0;
  const float pixels = dot.radius / (dot.z * view.pixelSlope);
  const float drawn = std::max(pixels, kLeastPixels);
  // A dot that had to be widened is as much thinner.
  const float widening = pixels / drawn;
  const Vector2f middle = view.toPixel(slope);
  return {middle.x(), middle.y(), drawn, dot.opacity * std::exp(-dot.fading * below) * widening * widening};
}

}  // namespace

std::vector<FoamDot> makeFoamDots(const core::DiffuseParticles& particles, const v1::Scene& scene, double spacing,
                                  const ViewGeometry& view) {
  const v1::Foam& foam = scene.foam();
  const auto radius = static_cast<float>(foam.radius_in_spacings() * spacing);
  const float opacity = -std::log(std::max(1 - static_cast<float>(foam.opacity()), kLeastSeenThrough));
  const v1::Vec3& absorption = scene.look().liquid().absorption();
  // Light passes the liquid above a bubble on its way down and on its way up. What else hides deep bubbles are those
  // above them and the liquid's own murk: to a third within ten spacings.
  const auto murk = static_cast<float>(2 * (absorption.x() + absorption.y() + absorption.z()) / 3 + 0.1 / spacing);
  // Foam and spray are of the surface: what a wave rolls over is gone within two spacings.
  const auto cover = static_cast<float>(0.5 / spacing);

  std::vector<FoamDot> dots;
  dots.reserve(particles.size());
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Vector3f middle = view.toView(particles.positions[i]);
    const DiffuseKind kind = particles.kinds[i];
    const KindLook look = lookOf(kind);
    const float share = shareOf(particles.ids[i]);
    const float size = radius * (look.leastSize + (look.mostSize - look.leastSize) * share);
    // Nearer than a few radii it would be a blot before the lens.
    if (middle.z() < 4 * size) continue;
    if (std::abs(middle.x()) > view.maxSlope.x() * middle.z() ||
        std::abs(middle.y()) > view.maxSlope.y() * middle.z()) {
      continue;
    }
    const float thinning = std::min(1.0F, particles.remaining[i] / kThinning);
    dots.push_back({middle.x(), middle.y(), middle.z(), size, opacity * look.opacity * thinning,
                    kind == DiffuseKind::Bubble ? murk : cover});
  }
  return dots;
}

float foamBed(const v1::Scene& scene, double spacing) {
  return static_cast<float>((0.5 + scene.look().splats().radius_in_spacings()) * spacing);
}

void drawFoam(std::span<const FoamDot> dots, const ViewGeometry& view, const FoamCovers& covers,
              std::span<float> opticalDepth) {
  const auto count = static_cast<std::ptrdiff_t>(dots.size());
  std::vector<Disc> discs(dots.size());
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    discs[static_cast<std::size_t>(i)] = discOf(dots[static_cast<std::size_t>(i)], view, covers);
  }

  // Pixels whose middle, at a half number, is inside.
  const auto first = [](float middle, float radius) {
    return std::max(0, static_cast<int>(std::ceil(middle - radius - 0.5F)));
  };
  const auto last = [](float middle, float radius, int size) {
    return std::min(size - 1, static_cast<int>(std::floor(middle + radius - 0.5F)));
  };
  const int strips = (view.size.height + kStripRows - 1) / kStripRows;
  std::vector<std::vector<std::uint32_t>> met(static_cast<std::size_t>(strips));
  for (std::uint32_t i = 0; i < discs.size(); ++i) {
    const Disc& disc = discs[i];
    // Below this nothing of it shows, whatever the exposure.
    if (disc.opacity < 1e-4F) continue;
    const int bottom = last(disc.y, disc.radius, view.size.height) / kStripRows;
    for (int s = first(disc.y, disc.radius) / kStripRows; s <= bottom; ++s)
      met[static_cast<std::size_t>(s)].push_back(i);
  }

#pragma omp parallel for schedule(dynamic)
  for (int s = 0; s < strips; ++s) {
    const int top = s * kStripRows;
    const int bottom = std::min(top + kStripRows, view.size.height) - 1;
    for (const std::uint32_t i : met[static_cast<std::size_t>(s)]) {
      const Disc& disc = discs[i];
      const float inverse = 1 / (disc.radius * disc.radius);
      const int left = first(disc.x, disc.radius);
      const int right = last(disc.x, disc.radius, view.size.width);
      for (int y = std::max(top, first(disc.y, disc.radius));
           y <= std::min(bottom, last(disc.y, disc.radius, view.size.height)); ++y) {
        const float dy = static_cast<float>(y) + 0.5F - disc.y;
        float* const row =
            opticalDepth.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(view.size.width);
        for (int x = left; x <= right; ++x) {
          const float dx = static_cast<float>(x) + 0.5F - disc.x;
          // 1 - ρ²: its square ends smoothly at the rim.
          const float inside = std::max(0.0F, 1 - (dx * dx + dy * dy) * inverse);
          row[x] += disc.opacity * inside * inside;
        }
      }
    }
  }
}

}  // namespace sluice::render
