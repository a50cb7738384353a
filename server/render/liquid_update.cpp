#include "liquid_update.h"

#include "picture_cover.h"

namespace sluice::render {

PixelRect placeOf(const Eigen::AlignedBox3f& bounds, const SplatScale& scale, const ViewGeometry& view) {
  if (bounds.isEmpty()) return {};
  constexpr float kLargestInRadii = 4;
  const auto reach = Eigen::Vector3f::Constant(kLargestInRadii * scale.radius);
  PictureCover cover(view);
  cover.add(Eigen::AlignedBox3f(bounds.min() - reach, bounds.max() + reach));
  return cover.pixels();
}

void aim(LiquidState& liquid, const v1::Look& look, const ViewGeometry& view, double spacing) {
  liquid.surfaceView = divided(view, look.smoothing().divisor());
  liquid.thicknessView = divided(view, look.thickness().divisor());
  liquid.scale = splatScale(look.splats(), spacing);
}

void followViolence(LiquidState& liquid, const v1::Look& look) {
  if (look.has_noise()) {
    liquid.marks.follow(*liquid.particles, look.noise());
  } else {
    liquid.marks = {};
  }
}

void takeParts(std::vector<std::unique_ptr<LiquidState>>& liquids, const core::ParticleSnapshot& particles) {
  const auto parts = splitByFluid(particles);
  liquids.resize(parts.size());
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (liquids[k] == nullptr) liquids[k] = std::make_unique<LiquidState>();
    liquids[k]->particles = parts[k];
  }
}

}  // namespace sluice::render
