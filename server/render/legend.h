#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "particle_values.h"
#include "sluice/v1/scene.pb.h"

namespace sluice::render {

/// Red, green, blue, sRGB-encoded, as in the pixels of a frame.
using Rgb8 = std::array<std::uint8_t, 3>;

/// Colours along a bar, and the values that they stand for.
struct ColourBar {
  std::string title;
  std::string unit;           ///< Empty for plain numbers.
  ValueRange range;           ///< In that unit.
  std::vector<Rgb8> colours;  ///< At even steps from the least value to the most; at least two.
};

/// The colours of normals, on a ball before the eye.
struct NormalBall {
  std::string title;
};

using LegendEntry = std::variant<ColourBar, NormalBall>;

/// What a picture's colours stand for, from the top down.
using LegendEntries = std::vector<LegendEntry>;

/// A palette's colours after the scene's tone map, kPaletteColours of them: they differ from the palette's own where no
/// radiance is shown as bright as those.
std::vector<Rgb8> shownColours(v1::ColourMap::PaletteCase palette, const v1::Tone& tone);

/// What a colour map's colours stand for; `colours` as shownColours() gives them.
ColourBar colourMapBar(const v1::ColourMap& map, const ValueRange& range, std::vector<Rgb8> colours);

/// The same of a study view; `range` is StudyPass::range(). `spacing` is that of the particles, m, which curvature is
/// measured by.
LegendEntry studyEntry(const v1::View& view, const ValueRange& range, double spacing, std::vector<Rgb8> colours);

/// Colour of a component-wise normal of length 1 with x to the right, y up and z towards the eye, as study.frag shows
/// it.
Rgb8 normalColour(float x, float y, float z);

/// In the multiple of its unit that gives numbers of few digits: mm for thin things, kPa for high pressures; a power of
/// ten where there is no such word.
ColourBar withReadableUnit(ColourBar bar);

/// Values to mark within a range: multiples of 1, 2 or 5 times a power of ten, three to five of them; up to seven where
/// the next such step leaves but two.
struct Ticks {
  std::vector<double> values;
  double step = 1;
};

Ticks ticksOf(const ValueRange& range);

/// As many decimals as steps of that size need.
std::string tickLabel(double value, double step);

}  // namespace sluice::render
