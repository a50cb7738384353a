#pragma once

#include <string_view>
#include <vector>

#include "sluice/core/particle_snapshot.h"
#include "sluice/v1/scene.pb.h"

namespace sluice::render {

/// What a colour map tells of particles, in words.
struct AttributeText {
  std::string_view title;
  std::string_view unit;  ///< Empty for plain numbers.
};

AttributeText textOf(v1::ColourMap::AttributeCase attribute);

/// Why particles cannot be coloured by it: which of the snapshot's arrays is missing. Empty where they can.
std::string_view missingFor(v1::ColourMap::AttributeCase attribute, const core::ParticleSnapshot& particles);

/// The attribute of every particle in the unit of its text. Empty where something is missing. Numbers beyond 2²⁴ of
/// particles are rounded to floats.
std::vector<float> valuesOf(v1::ColourMap::AttributeCase attribute, const core::ParticleSnapshot& particles);

/// Velocity of every particle along the map's direction, or its speed where that has no length, m/s. Empty where the
/// source gives no velocities.
std::vector<float> velocitiesOf(const v1::VelocityMap& map, const core::ParticleSnapshot& particles);

/// Values that the first and the last colour stand for.
struct ValueRange {
  float least = 0;
  float most = 1;

  float width() const { return most - least; }
  bool operator==(const ValueRange&) const = default;
};

/// A range from 1st to 99th percentile, so that a few strays do not take all the colours, widened to round numbers
/// (multiples of 1, 2 or 5 times a power of ten, a fifth to an eighth of its width): the legend reads well, and the
/// range rests while the particles move. `previous` is kept for as long as it still fits: it holds all of the new one,
/// which fills at least 60 % of it. `aboutZero` makes a range that holds 0 symmetric: for palettes with a middle.
ValueRange robustRange(const std::vector<float>& values, bool aboutZero, const ValueRange* previous = nullptr);

/// The least 1, 2 or 5 times a power of ten that is not below `value`, > 0.
double niceStep(double value);

}  // namespace sluice::render
