#include "legend.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string_view>
#include <utility>

#include "palette.h"
#include "study_pass.h"
#include "tone_curve.h"
#include "value_colours.h"

namespace sluice::render {

namespace {

std::uint8_t level(float encoded) {
  return static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(encoded, 0.0F, 1.0F)));
}

/// Red through black to green, see study.frag.
std::vector<Rgb8> curvatureColours() {
  std::vector<Rgb8> colours;
  for (int i = 0; i < 256; ++i) {
    const float curvature = static_cast<float>(i) / 127.5F - 1.0F;
    colours.push_back({level(-curvature), level(curvature), 0});
  }
  return colours;
}

/// Units that take prefixes.
bool takesPrefix(std::string_view unit) { return unit == "m" || unit == "m/s" || unit == "Pa" || unit == "s"; }

/// A power of ten in front of a unit, of three digits each.
std::string multiple(int thousands, const std::string& unit) {
  if (takesPrefix(unit) && std::abs(thousands) <= 2) {
    constexpr std::array<std::string_view, 5> kPrefixes{"µ", "m", "", "k", "M"};
    return std::string(kPrefixes[static_cast<std::size_t>(thousands + 2)]) + unit;
  }
  constexpr std::array<std::string_view, 10> kSuperscripts{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string power = thousands < 0 ? "10⁻" : "10";
  for (const char digit : std::to_string(std::abs(3 * thousands))) {
    power += kSuperscripts[static_cast<std::size_t>(digit - '0')];
  }
  if (unit.empty()) return power;
  // 10³/m, not 10³ 1/m.
  return unit.starts_with("1/") ? power + unit.substr(1) : power + " " + unit;
}

}  // namespace

std::vector<Rgb8> shownColours(v1::ColourMap::PaletteCase palette, const v1::Tone& tone) {
  std::vector<Rgb8> colours;
  for (std::size_t i = 0; i < kPaletteColours; ++i) {
    const Eigen::Vector3f colour = paletteColour(palette, static_cast<float>(i) / (kPaletteColours - 1));
    const auto shown = [&](float encoded) {
      return level(encodeSrgb(toneMapped(radianceShownAs(linearOfSrgb(encoded), tone), tone)));
    };
    colours.push_back({shown(colour.x()), shown(colour.y()), shown(colour.z())});
  }
  return colours;
}

ColourBar colourMapBar(const v1::ColourMap& map, const ValueRange& range, std::vector<Rgb8> colours) {
  const AttributeText text = textOf(map.attribute_case());
  return {std::string(text.title), std::string(text.unit), range, std::move(colours)};
}

LegendEntry studyEntry(const v1::View& view, const ValueRange& range, double spacing, std::vector<Rgb8> colours) {
  const auto bar = [&](const char* title, const char* unit) {
    return ColourBar{title, unit, range, std::move(colours)};
  };
  switch (view.shows_case()) {
    case v1::View::kRawDepth:
      return bar("Depth of the splats", "m");
    case v1::View::kSmoothedDepth:
      return bar("Depth of the surface", "m");
    case v1::View::kNormals:
      return NormalBall{"Normal"};
    case v1::View::kCurvature: {
      const auto perMetre = static_cast<float>(1.0 / spacing);
      return ColourBar{"Mean curvature", "1/m", {range.least * perMetre, range.most * perMetre}, curvatureColours()};
    }
    case v1::View::kNoise:
      return bar("Height of the noise", "m");
    case v1::View::kFoam:
      return bar("Share hidden by foam", "");
    default:
      return bar("Thickness", "m");
  }
}

Rgb8 normalColour(float x, float y, float z) {
  return {level(0.5F + 0.5F * x), level(0.5F + 0.5F * y), level(0.5F + 0.5F * z)};
}

ColourBar withReadableUnit(ColourBar bar) {
  // From there numbers have more than four digits, or, where no word makes them shorter, five; or two zeros after the
  // point before the first that tells anything.
  const float tooLarge = takesPrefix(bar.unit) ? 1e4F : 1e5F;
  constexpr float kTooSmall = 0.02F;
  const float largest = std::max(std::abs(bar.range.least), std::abs(bar.range.most));
  if (largest == 0.0F || (largest >= kTooSmall && largest < tooLarge)) return bar;
  const int thousands = static_cast<int>(std::floor(std::log10(largest) / 3.0F + 1e-6F));
  if (thousands == 0) return bar;
  const auto factor = static_cast<float>(std::pow(10.0, -3.0 * thousands));
  bar.range = {bar.range.least * factor, bar.range.most * factor};
  bar.unit = multiple(thousands, bar.unit);
  return bar;
}

namespace {

/// Multiples of `step` in the range, with a hair of room for ends that are multiples themselves.
std::vector<double> multiplesOf(double step, const ValueRange& range) {
  const double hair = 1e-4 * static_cast<double>(range.width()) / step;
  const double first = std::ceil(static_cast<double>(range.least) / step - hair);
  const double last = std::floor(static_cast<double>(range.most) / step + hair);
  std::vector<double> multiples;
  // Adding 0 makes -0 to 0.
  for (double k = first; k <= last; ++k) multiples.push_back(k * step + 0.0);
  return multiples;
}

}  // namespace

Ticks ticksOf(const ValueRange& range) {
  constexpr std::size_t kMost = 5;
  constexpr std::size_t kLeast = 3;
  // Seven ticks at least.
  double step = niceStep(static_cast<double>(range.width()) / 16.0);
  Ticks ticks{multiplesOf(step, range), step};
  while (ticks.values.size() > kMost) {
    step = niceStep(1.1 * step);
    std::vector<double> fewer = multiplesOf(step, range);
    if (fewer.size() < kLeast) break;
    ticks = {std::move(fewer), step};
  }
  return ticks;
}

std::string tickLabel(double value, double step) {
  const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
  std::array<char, 64> digits{};
  std::snprintf(digits.data(), digits.size(), "%.*f", decimals, std::abs(value));
  // A minus sign is as wide as a plus, unlike the hyphen.
  return (value < 0 ? "−" : "") + std::string(digits.data());
}

}  // namespace sluice::render
