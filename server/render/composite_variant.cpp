#include "composite_variant.h"

#include "environment.h"

namespace sluice::render {

namespace {

bool isBlack(const v1::Vec3& colour) { return colour.x() <= 0 && colour.y() <= 0 && colour.z() <= 0; }

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
  if (!reflection) names.emplace_back("NO_REFLECTION");
  if (layered) names.emplace_back("LAYERED");
  if (noise) names.emplace_back("NOISE");
  if (whitening) names.emplace_back("WHITENING");
  return names;
}

bool isOpaque(const v1::Liquid& liquid) { return liquid.opaque() || liquid.has_metal(); }

Refraction refractionOf(const v1::Liquid& liquid) {
  if (isOpaque(liquid)) return Refraction::None;
  if (liquid.has_screen_shift()) return Refraction::ScreenShift;
  if (liquid.has_two_interfaces()) return Refraction::TwoInterfaces;
  return Refraction::Snell;
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
  variant.reflection = !whyNoReflection(liquid, scene.background());
  variant.layered = layered;
  return variant;
}

}  // namespace sluice::render
