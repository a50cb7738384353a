#pragma once

#include <cstddef>

#include <Eigen/Core>

#include "sluice/v1/scene.pb.h"

namespace sluice::render {

/// Colours of a table for a GPU: fine enough that steps between them are below one level of eight bits.
inline constexpr std::size_t kPaletteColours = 256;

/// The palette's colour, sRGB-encoded as screens show it, at `share` of the way from its first to its last; outside
/// [0, 1] the colour of that end. Without a palette: viridis, the default.
Eigen::Vector3f paletteColour(v1::ColourMap::PaletteCase palette, float share);

/// Linear light of an sRGB-encoded component, IEC 61966-2-1; encodeSrgb() goes back.
float linearOfSrgb(float encoded);

/// Perceived lightness L* (CIE 1976, white point D65) of an sRGB-encoded colour, 0 to 100.
float lightness(const Eigen::Vector3f& srgb);

}  // namespace sluice::render
