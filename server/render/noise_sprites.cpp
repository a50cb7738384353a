#include "noise_sprites.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>

namespace sluice::render {

namespace {

/// Most octaves that the schema lets a look have.
constexpr unsigned kMostOctaves = 6;

/// Least radius of a sprite, in spacings: any smaller, sprites of neighbours leave gaps. Octaves beyond have more
/// cells in a radius instead.
constexpr double kLeastRadius = 1.0;

/// Least radius in pixels: below, a sprite falls between pixels.
constexpr float kLeastPixels = 1.5F;

/// Room for what of a disc is on the negative side of its centre; a whole number, in which floats have 20 bits for the
/// fraction.
constexpr float kOrigin = 64.0F;

struct Octave {
  float radius;  ///< Of a sprite, m.
  float cell;    ///< Edge of a cell, m.
};

double radiusInSpacings(const v1::Noise& noise, unsigned octave) {
  return std::max(std::ldexp(noise.radius_in_spacings(), -static_cast<int>(octave)), kLeastRadius);
}

std::array<Octave, kMostOctaves> octavesOf(const v1::Noise& noise, double spacing) {
  std::array<Octave, kMostOctaves> octaves{};
  for (unsigned o = 0; o < kMostOctaves; ++o) {
    const double cell = std::ldexp(noise.radius_in_spacings() / kNoiseCellsPerRadius, -static_cast<int>(o));
    octaves[o] = {static_cast<float>(radiusInSpacings(noise, o) * spacing), static_cast<float>(cell * spacing)};
  }
  return octaves;
}

/// [0, 1) of bits of a hash.
float unit(std::uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24F; }

}  // namespace

std::uint32_t scrambled(std::uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352dU;
  x ^= x >> 15;
  x *= 0x846ca68bU;
  x ^= x >> 16;
  return x;
}

unsigned octaveOf(std::uint32_t hash, const v1::Noise& noise) {
  // As many as fit into a place: in inverse proportion to a sprite's area.
  const auto share = [&](unsigned o) { return 1.0 / (radiusInSpacings(noise, o) * radiusInSpacings(noise, o)); };
  double all = 0;
  for (unsigned o = 0; o < noise.octaves(); ++o) all += share(o);
  double left = unit(hash) * all;
  for (unsigned o = 0; o + 1 < noise.octaves(); ++o) {
    left -= share(o);
    if (left < 0) return o;
  }
  return noise.octaves() - 1;
}

float typicalNoise(const v1::Noise& noise, float spacing) {
  // Every octave has the same slope, and the same part of the surface: heights go with the cells.
  const auto octaves = octavesOf(noise, spacing);
  float squares = 0;
  for (unsigned o = 0; o < noise.octaves(); ++o) squares += octaves[o].cell * octaves[o].cell;
  const float cell = std::sqrt(squares / static_cast<float>(noise.octaves()));
  return static_cast<float>(noise.amplitude()) * cell * kNoiseHeight / kNoiseSlope;
}

std::vector<NoiseSprite> makeNoiseSprites(const core::ParticleSnapshot& particles, const SplatSelection& selection,
                                          std::span<const float> violence, const v1::Noise& noise,
                                          const ViewGeometry& target, float nearDepth) {
  std::vector<std::uint32_t> drawn;
  drawn.reserve(selection.points.size() + selection.large.size());
  std::ranges::merge(selection.points.particles, selection.large, std::back_inserter(drawn));

  const auto octaves = octavesOf(noise, particles.spacing);
  const auto amplitude = static_cast<float>(noise.amplitude()) / kNoiseSlope;
  const auto still = static_cast<float>(noise.still_share());
  std::vector<NoiseSprite> sprites(drawn.size());
  const auto count = static_cast<std::ptrdiff_t>(drawn.size());
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t k = 0; k < count; ++k) {
    const std::uint32_t i = drawn[static_cast<std::size_t>(k)];
    NoiseSprite& sprite = sprites[static_cast<std::size_t>(k)];
    const Eigen::Vector3f centre = target.toView(particles.positions[i]);
    if (centre.z() <= nearDepth) {
      sprite = {};
      continue;
    }
    // One number after another of a row that the id begins.
    const std::uint32_t first = scrambled(particles.ids.empty() ? i : particles.ids[i]);
    const std::uint32_t second = scrambled(first + 0x9e3779b9U);
    const std::uint32_t third = scrambled(second + 0x9e3779b9U);
    const std::uint32_t fourth = scrambled(third + 0x9e3779b9U);
    const Octave& octave = octaves[octaveOf(first, noise)];
    const float pixel = target.pixelSlope * centre.z();
    const float radius = std::max(octave.radius, kLeastPixels * pixel);
    const float turn = 2.0F * std::numbers::pi_v<float> * unit(second);
    const float cells = radius / octave.cell;
    const float mark = violence.empty() ? 0.0F : violence[i];
    // Waves are at least two cells long. Those that pixels no longer show, from four pixels down, fade out.
    const float shown = std::clamp(octave.cell / pixel - 1.0F, 0.0F, 1.0F);
    sprite = {centre.x(),
              centre.y(),
              centre.z(),
              radius,
              cells * std::cos(turn),
              cells * std::sin(turn),
              kOrigin + unit(third),
              kOrigin + unit(fourth),
              second ^ (fourth << 1),
              amplitude * octave.cell * shown * std::lerp(still, 1.0F, mark),
              mark};
  }
  std::erase_if(sprites, [](const NoiseSprite& sprite) { return sprite.radius <= 0; });
  return sprites;
}

}  // namespace sluice::render
