#include "enclosure_samples.h"

#include <cmath>
#include <numbers>

#include "boundary.h"
#include "sluice/solids/body_shape.h"

namespace sluice::sim {

namespace {

using Eigen::Vector3d;
using Round = solids::Enclosure::Round;

/// A sphere or a closed cylinder around the container's, `behind` m farther out.
std::unique_ptr<const solids::BodyShape> shellOf(const solids::Enclosure& enclosure, double behind) {
  v1::Body body;
  const double radius = enclosure.round()->radius + behind;
  if (enclosure.round()->isUpright) {
    body.mutable_cylinder()->set_radius(radius);
    body.mutable_cylinder()->set_height(enclosure.bounds().sizes().y() + 2 * behind);
  } else {
    body.mutable_sphere()->set_radius(radius);
  }
  return solids::makeBodyShape(body, "simulation");
}

/// Points of a square lattice on a plane that covers a box, and on planes behind it.
template <class Add>
void samplePlane(const solids::Enclosure::Plane& plane, const Eigen::AlignedBox3d& box, double spacing, int layers,
                 const Add& add) {
  const Vector3d u = plane.normal.unitOrthogonal();
  const Vector3d v = plane.normal.cross(u);
  const Vector3d middle = box.center() - (plane.normal.dot(box.center()) - plane.offset) * plane.normal;
  const auto reach = static_cast<int>(std::ceil(0.5 * box.sizes().norm() / spacing)) + layers;
  for (int layer = 0; layer < layers; ++layer) {
    for (int j = -reach; j <= reach; ++j) {
      for (int i = -reach; i <= reach; ++i) add(Vector3d(middle + spacing * (i * u + j * v - layer * plane.normal)));
    }
  }
}

}  // namespace

std::vector<Float4> sampleEnclosure(const Container& container, double spacing, double support, int layers) {
  const solids::Enclosure& enclosure = *container.enclosure;
  std::vector<Float4> points;
  const auto add = [&](const Vector3d& x) {
    // Behind another face: farther than a support from all fluid.
    if (enclosure.distance(x) < -support) return;
    points.push_back({static_cast<float>(x.x()), static_cast<float>(x.y()), static_cast<float>(x.z()), 0});
  };
  if (enclosure.round()) {
    const Vector3d middle = enclosure.bounds().center();
    for (int layer = 0; layer < layers; ++layer) {
      shellOf(enclosure, layer * spacing)->sample({spacing, 0, 1}, [&](const Vector3d& x) { add(middle + x); });
    }
  } else {
    for (const Float4& p : sampleBox(container, spacing, layers)) add({p.x, p.y, p.z});
  }
  for (std::size_t k = enclosure.ownPlanes(); k < enclosure.planes().size(); ++k) {
    samplePlane(enclosure.planes()[k], enclosure.bounds(), spacing, layers, add);
  }
  return points;
}

double expectedEnclosureSamples(const solids::Enclosure& enclosure, double spacing, int layers) {
  const Vector3d size = enclosure.bounds().sizes();
  double area = 2 * (size.x() * size.y() + size.y() * size.z() + size.z() * size.x());
  if (enclosure.round()) area = shellOf(enclosure, 0)->area({spacing, 0, 1});
  const auto planes = static_cast<double>(enclosure.planes().size() - enclosure.ownPlanes());
  // A plane's lattice spans the diagonal of the box before it is cut.
  area += planes * size.squaredNorm();
  return layers * area / (spacing * spacing);
}

}  // namespace sluice::sim
