#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sluice/v1/scene.pb.h"

namespace sluice::render {

/// How light passes a liquid.
enum class Refraction : std::uint8_t { None, Snell, ScreenShift, TwoInterfaces };

/// What a liquid's surface mirrors.
enum class Reflection : std::uint8_t {
  None,
  Surroundings,  ///< Environment and floor,
  CubeMap,       ///< and bodies as its cube map has them,
  Screen,        ///< or as the picture shows them.
};

/// Which parts of the composite's shader a liquid needs.
struct CompositeVariant {
  Refraction refraction = Refraction::Snell;  ///< None for an opaque liquid.
  bool metal = false;
  bool emission = false;
  bool phong = false;
  bool highlight = false;
  Reflection reflection = Reflection::Surroundings;
  bool lamps = false;
  bool bodies = false;  ///< Some stand in the scene, so that not all that is seen beside the liquid is behind it.
  bool plain = false;   ///< Whatever is behind the liquid looks the same.
  bool noise = false;
  bool whitening = false;

  auto operator<=>(const CompositeVariant&) const = default;
  std::vector<std::string_view> defines() const;
};

/// Whether it reads the picture of the scene without the liquid.
bool looksUpScene(const CompositeVariant& variant);

/// Whether nothing is seen through the liquid; metals are opaque, whatever else is set.
bool isOpaque(const v1::Liquid& liquid);

/// How light passes this liquid.
Refraction refractionOf(const v1::Liquid& liquid);

/// Whether anything that is no glass stands in the scene.
bool hasMatteBodies(const v1::Scene& scene);

/// Why nothing is mirrored, or only environment and floor; empty where bodies are, too.
std::optional<std::string> whyNoReflection(const v1::Liquid& liquid, const v1::Background& background);
std::optional<std::string> whyNoCubeMap(const v1::Liquid& liquid, const v1::Scene& scene);

/// Why it does not matter where a line of sight goes behind the liquid: there is nothing but one colour. Empty where it
/// does.
std::optional<std::string> whyPlainBehind(const v1::Scene& scene, bool layered);

/// Whether lights show on it as highlights: neither their strength nor the sun's is 0.
bool hasHighlight(const v1::Liquid& liquid, const v1::Lighting& lighting);

/// What the composite of such a liquid takes.
CompositeVariant compositeVariant(const v1::Liquid& liquid, const v1::Scene& scene, bool layered);

}  // namespace sluice::render
