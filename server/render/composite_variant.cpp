#include "composite_variant.h"

#include <algorithm>

namespace sluice::render {

namespace {

bool isBlack(const v1::Vec3& colour) { return colour.x() <= 0 && colour.y() <= 0 && colour.z() <= 0; }

Reflection reflectionOf(const v1::Liquid& liquid, const v1::Scene& scene) {
  if (whyNoReflection(liquid, scene.background())) return Reflection::None;
  if (!whyNoCubeMap(liquid, scene)) return Reflection::CubeMap;
  return liquid.has_screen_space() && hasMatteBodies(scene) ? Reflection::Screen : Reflection::Surroundings;
}

}  // namespace

std::vector<std::string_view> CompositeVariant::defines() const {
  std::vector<std::string_view> names;
  if (refraction == Refraction::None) names.emplace_back("OPAQUE");
  if (refraction == Refraction::ScreenShift) names.emplace_back("SCREEN_SHIFT");
  if (refraction == Refraction::TwoInterfaces) names.emplace_back("TWO_INTERFACES");
  if (metal) names.emplace_back("METAL");
  if (emission) names.emplace_back("EMISSION");
  if (phong) names.emplace_back("PHONG");
  if (highlight) names.emplace_back("HIGHLIGHT");
  if (reflection == Reflection::None) names.emplace_back("NO_REFLECTION");
  if (reflection == Reflection::CubeMap || reflection == Reflection::Screen) names.emplace_back("BODY_MIRROR");
  if (reflection == Reflection::CubeMap) names.emplace_back("CUBE_MAP");
  if (lamps) names.emplace_back("LAMPS");
  if (bodies) names.emplace_back("BODIES");
  if (plain) names.emplace_back("PLAIN_BEHIND");
  if (noise) names.emplace_back("NOISE");
  if (whitening) names.emplace_back("WHITENING");
  return names;
}

bool looksUpScene(const CompositeVariant& variant) {
  return (variant.refraction != Refraction::None && !variant.plain) || variant.reflection == Reflection::Screen;
}

bool isOpaque(const v1::Liquid& liquid) { return liquid.opaque() || liquid.has_metal(); }

Refraction refractionOf(const v1::Liquid& liquid) {
  if (isOpaque(liquid)) return Refraction::None;
  if (liquid.has_screen_shift()) return Refraction::ScreenShift;
  if (liquid.has_two_interfaces()) return Refraction::TwoInterfaces;
  return Refraction::Snell;
}

bool hasMatteBodies(const v1::Scene& scene) {
  return std::ranges::any_of(scene.bodies(), [](const v1::Body& body) { return !body.has_glass(); });
}

std::optional<std::string> whyNoReflection(const v1::Liquid& liquid, const v1::Background& background) {
  if (liquid.has_no_reflection()) return "look.liquid.no_reflection is chosen";
  if (background.has_backdrop()) return "a backdrop is not mirrored";
  return std::nullopt;
}

std::optional<std::string> whyNoCubeMap(const v1::Liquid& liquid, const v1::Scene& scene) {
  if (auto why = whyNoReflection(liquid, scene.background())) return why;
  if (liquid.has_surroundings()) return "look.liquid.surroundings is chosen";
  if (liquid.has_screen_space()) return "look.liquid.screen_space is chosen";
  if (!hasMatteBodies(scene)) return "there is no body to mirror; floor and surroundings are mirrored as they are";
  return std::nullopt;
}

std::optional<std::string> whyPlainBehind(const v1::Scene& scene, bool layered) {
  const v1::Background& background = scene.background();
  const bool plain = background.has_uniform() || background.has_backdrop();
  if (!plain || background.floor() || !scene.bodies().empty() || layered) return std::nullopt;
  return "nothing but one colour is behind the liquid";
}

bool hasHighlight(const v1::Liquid& liquid, const v1::Lighting& lighting) {
  const double strength = liquid.has_phong() ? liquid.phong().specular() : liquid.physical().specular();
  return strength > 0 && lighting.sun().strength() > 0;
}

CompositeVariant compositeVariant(const v1::Liquid& liquid, const v1::Scene& scene, bool layered) {
  CompositeVariant variant;
  variant.refraction = refractionOf(liquid);
  variant.metal = liquid.has_metal();
  variant.emission = variant.refraction == Refraction::None && !variant.metal && !isBlack(liquid.emission());
  variant.phong = liquid.has_phong() && !variant.metal;
  variant.highlight = hasHighlight(liquid, scene.lighting());
  variant.reflection = reflectionOf(liquid, scene);
  variant.lamps = !scene.lighting().point_lights().empty();
  variant.bodies = hasMatteBodies(scene);
  variant.plain = variant.refraction != Refraction::None && whyPlainBehind(scene, layered).has_value();
  return variant;
}

}  // namespace sluice::render
