#pragma once

#include <compare>
#include <cstdint>
#include <string_view>
#include <vector>

#include "sluice/v1/scene.pb.h"

namespace sluice::render {

/// How light passes a liquid.
enum class Refraction : std::uint8_t { None, Snell, ScreenShift, TwoInterfaces };

/// Which parts of the composite's shader a liquid needs.
struct CompositeVariant {
  Refraction refraction = Refraction::Snell;  ///< None for an opaque liquid.
  bool metal = false;
  bool emission = false;
  bool phong = false;
  bool highlight = false;
  bool reflection = true;
  bool layered = false;
  bool noise = false;
  bool whitening = false;

  auto operator<=>(const CompositeVariant&) const = default;
  std::vector<std::string_view> defines() const;
};

/// Whether nothing is seen through the liquid; metals are opaque, whatever else is set.
bool isOpaque(const v1::Liquid& liquid);

/// How light passes this liquid.
Refraction refractionOf(const v1::Liquid& liquid);

/// Whether lights show on it as highlights: neither their strength nor the sun's is 0.
bool hasHighlight(const v1::Liquid& liquid, const v1::Lighting& lighting);

/// What the composite of such a liquid takes.
CompositeVariant compositeVariant(const v1::Liquid& liquid, const v1::Scene& scene, bool layered);

}  // namespace sluice::render
