#pragma once

#include "frame_uniforms.h"
#include "sluice/render/frame_plan.h"
#include "splat_selection.h"

namespace sluice::render {

/// What a plan needs to know of the splats that were selected for a picture.
inline DataTraits dataTraits(const SplatSelection& selection, const SplatScale& scale, const ViewGeometry& view) {
  DataTraits traits;
  traits.spacing = scale.spacing;
  traits.points = selection.points.size();
  traits.hiddenPoints = selection.points.size() - selection.visiblePoints;
  traits.interiorPoints = selection.interiorPoints;
  traits.largeSplats = selection.large.size();
  traits.nearestDepth = selection.nearestDepth;
  traits.pixelSlope = view.pixelSlope;
  return traits;
}

}  // namespace sluice::render
