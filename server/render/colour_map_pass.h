#pragma once

#include <map>
#include <optional>
#include <span>
#include <utility>

#include "attribute_programs.h"
#include "attribute_raster.h"
#include "value_colours.h"

namespace sluice::render {

/// Brings a value of the particles to the surface and shows it over the shaded liquid: the velocity map's white, and
/// the colour map's colours.
class ColourMapPass {
 public:
  void runVelocityMap(const FrameContext& frame);
  void runColourMap(const FrameContext& frame);

  /// What the colours of the last colour map of a liquid stand for.
  ValueRange range(std::uint8_t liquid) const;

 private:
  void spread(const FrameContext& frame, const std::vector<float>& values);
  void spreadOnDevice(const FrameContext& frame, std::span<const ViewValue> particles);
  void draw(const FrameContext& frame, bool whitening, const ColourTable& colours, const ValueRange& range,
            double strength);

  AttributeRaster raster_;
  std::optional<AttributePrograms> onDevice_;
  ColourTable palette_;
  ColourTable white_;
  std::map<std::uint8_t, std::pair<v1::ColourMap::AttributeCase, ValueRange>> ranges_;
  std::map<std::pair<bool, bool>, gl::Program> programs_;  ///< By whitening, and whether there are several liquids.
};

/// The picture of a colour map's values: half as fine as the surface, as values change over particles, not pixels.
ViewGeometry attributeView(const FrameContext& frame);

}  // namespace sluice::render
