#pragma once

#include "frame_uniforms.h"
#include "particle_values.h"
#include "sluice/render/frame_plan.h"
#include "splat_selection.h"

namespace sluice::render {

/// What a plan needs to know of the splats that were selected for a picture.
inline DataTraits dataTraits(const core::ParticleSnapshot& particles, const SplatSelection& selection,
                             const SplatScale& scale, const ViewGeometry& view, const v1::Look& look) {
  DataTraits traits;
  traits.spacing = scale.spacing;
  traits.points = selection.points.size();
  traits.hiddenPoints = selection.points.size() - selection.visible.size();
  traits.interiorPoints = selection.interiorPoints;
  traits.largeSplats = selection.large.size();
  traits.sprayDrops = selection.spray.size();
  traits.nearestDepth = selection.nearestDepth;
  traits.pixelSlope = view.pixelSlope;
  traits.densities = !particles.densities.empty();
  traits.neighbourCounts = !particles.neighbours.empty();
  traits.ids = !particles.ids.empty();
  traits.velocities = !particles.velocities.empty();
  if (particles.velocities.empty()) traits.velocityMapMissing = "the source gives no velocities";
  traits.colourMapMissing = missingFor(look.colour_map().attribute_case(), particles);
  return traits;
}

}  // namespace sluice::render
