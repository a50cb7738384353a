#pragma once

#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "sluice/v1/scene.pb.h"

namespace sluice::solids {

/// The point of a surface that is closest to another; far away where none is within the distance asked for.
struct ClosestPoint {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  double distance = std::numeric_limits<double>::infinity();  ///< m, ≥ 0 on either side.
};

/// How a body's surface is sampled by boundary particles.
struct SurfaceSampling {
  double spacing = 0;  ///< d, m.
  /// How far within a solid body's surface the outermost layer is, m. Fluid comes to rest one spacing from a layer with
  /// half a spacing of its own: with half a spacing here it reaches the surface, and displaces just the body's volume.
  double inset = 0;
  int layers = 1;  ///< Of a solid body: the surface, and others inside it one spacing behind one another.
};

/// The surface of a body in its own axes. Immutable; all functions are thread-safe.
class BodyShape {
 public:
  using AddPoint = std::function<void(const Eigen::Vector3d&)>;

  virtual ~BodyShape() = default;

  virtual Eigen::AlignedBox3d bounds() const = 0;

  /// Whether the surface has an inside.
  virtual bool isClosed() const = 0;

  /// Whether a point lies inside a closed surface.
  virtual bool contains(const Eigen::Vector3d& x) const = 0;

  /// The surface's closest point; one that is not nearer than `reach` need not be found.
  virtual ClosestPoint closest(const Eigen::Vector3d& x, double reach) const = 0;

  /// Area of all layers, m²: about one sample comes to each spacing squared.
  virtual double area(const SurfaceSampling& sampling) const = 0;

  /// The triangles of a mesh; none of other shapes.
  virtual std::vector<std::array<Eigen::Vector3d, 3>> triangles() const { return {}; }

  /// Calls `add` with points about one spacing apart, always the same ones in the same order.
  virtual void sample(const SurfaceSampling& sampling, const AddPoint& add) const = 0;
};

/// The shape of a body of a complete scene. A mesh that cannot be read is a core::InputError under `fieldPath`
/// ("bodies[2]").
std::unique_ptr<const BodyShape> makeBodyShape(const v1::Body& body, const std::string& fieldPath);

}  // namespace sluice::solids
