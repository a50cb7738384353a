#include "upload_splats.h"

#include <algorithm>
#include <functional>
#include <vector>

namespace sluice::render {

void uploadSplats(LiquidState& liquid, std::size_t k, const FramePlan& plan, const ViewGeometry& view,
                  const DeviceTraits& device) {
  const SplatSelection& selection = liquid.selection;
  const auto sphere = [&](std::uint32_t index, float radius) {
    const Eigen::Vector3f centre = view.toView(liquid.particles->positions[index]);
    return ViewSphere{centre.x(), centre.y(), centre.z(), radius};
  };
  const bool ellipsoids = liquid.model.shape == SplatShape::Ellipsoid;
  const auto uploadPoints = [&](SplatArray& array, const SplatList& list) {
    ellipsoids ? array.upload(list.ellipsoids) : array.upload(list.spheres);
  };
  if (!device.software && plan.runs(Pass::Splats, k)) uploadPoints(liquid.splats.visible, selection.visible);
  if (!device.software && plan.runs(Pass::Thickness, k)) uploadPoints(liquid.splats.points, selection.points);
  if (plan.runs(Pass::LargeSplats, k) && ellipsoids) {
    std::vector<ViewEllipsoid> large;
    for (const std::uint32_t index : selection.large) large.push_back(toView(liquid.model.ellipsoids[index], view));
    liquid.splats.large.upload(large);
  } else if (plan.runs(Pass::LargeSplats, k)) {
    std::vector<ViewSphere> large;
    for (const std::uint32_t index : selection.large) {
      large.push_back(sphere(index, liquid.model.radius(index, liquid.scale.radius)));
    }
    liquid.splats.large.upload(large);
  }
  if (plan.runs(Pass::Spray, k)) {
    std::vector<ViewSphere> drops;
    for (const std::uint32_t index : selection.spray) drops.push_back(sphere(index, liquid.scale.dropRadius));
    // The farthest first: each is drawn over those behind it.
    std::ranges::stable_sort(drops, std::greater{}, &ViewSphere::z);
    liquid.splats.spray.upload(drops);
  }
}

}  // namespace sluice::render
