#include "sluice/solids/body_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "mesh_shape.h"
#include "sluice/core/input_error.h"
#include "sluice/particleio/mesh_file.h"
#include "sluice/scene/convert.h"

namespace sluice::solids {

namespace {

using Eigen::Vector3d;

constexpr double kTurn = 2 * std::numbers::pi;

/// Layers that fit into a solid body whose narrowest extent is `thickness`: the innermost is not a folded sheet.
int fittingLayers(const SurfaceSampling& sampling, double thickness) {
  const double fitting = 1 + std::floor(((thickness - 2 * sampling.inset) / sampling.spacing - 0.5) / 2);
  return std::clamp(static_cast<int>(std::min(fitting, 1e6)), 1, std::max(1, sampling.layers));
}

/// How far a layer is within the surface, m.
double depthOf(int layer, const SurfaceSampling& sampling) { return sampling.inset + layer * sampling.spacing; }

/// Points of a circle around y, evenly; one on the axis where it is narrower than they are apart.
void sampleRing(double radius, double y, double spacing, const BodyShape::AddPoint& add) {
  const std::int64_t n = std::llround(kTurn * radius / spacing);
  if (n < 2) return add({0, y, 0});
  for (std::int64_t k = 0; k < n; ++k) {
    const double angle = kTurn * static_cast<double>(k) / static_cast<double>(n);
    add({radius * std::sin(angle), y, radius * std::cos(angle)});
  }
}

class BoxSurface : public BodyShape {
 public:
  explicit BoxSurface(const v1::BoxShape& box) : size_(scene::toVector(box.size())), openTop_(box.open_top()) {}

  Eigen::AlignedBox3d bounds() const override { return {-0.5 * size_, 0.5 * size_}; }
  bool isClosed() const override { return !openTop_; }
  bool contains(const Vector3d& x) const override {
    return isClosed() && (x.array().abs() < 0.5 * size_.array()).all();
  }

  ClosestPoint closest(const Vector3d& x, double) const override {
    const Vector3d half = 0.5 * size_;
    ClosestPoint best;
    for (int axis = 0; axis < 3; ++axis) {
      for (const double side : {-1.0, 1.0}) {
        if (openTop_ && axis == 1 && side > 0) continue;
        Vector3d point = x.cwiseMax(-half).cwiseMin(half);
        point[axis] = side * half[axis];
        const double distance = (x - point).norm();
        if (distance < best.distance) best = {point, distance};
      }
    }
    return best;
  }

  double area(const SurfaceSampling& sampling) const override {
    double total = 0;
    for (int layer = 0; layer < layersOf(sampling); ++layer) {
      const Vector3d s = shell(layer, sampling);
      total += 2 * (s.x() * s.y() + s.y() * s.z() + s.z() * s.x()) - (openTop_ ? s.x() * s.z() : 0);
    }
    return total;
  }

  void sample(const SurfaceSampling& sampling, const AddPoint& add) const override {
    for (int layer = 0; layer < layersOf(sampling); ++layer) sampleShell(shell(layer, sampling), sampling.spacing, add);
  }

 private:
  int layersOf(const SurfaceSampling& sampling) const {
    return openTop_ ? 1 : fittingLayers(sampling, size_.minCoeff());
  }

  Vector3d shell(int layer, const SurfaceSampling& sampling) const {
    return (size_.array() - 2 * depthOf(layer, sampling)).max(0).matrix();
  }

  /// Points of the faces of a lattice that fills a box; a box thinner than half a spacing is one sheet.
  void sampleShell(const Vector3d& size, double spacing, const AddPoint& add) const {
    std::array<std::int64_t, 3> n{};
    for (int axis = 0; axis < 3; ++axis) n[static_cast<std::size_t>(axis)] = std::llround(size[axis] / spacing);
    const auto place = [&](int axis, std::int64_t step) {
      const std::int64_t steps = n[static_cast<std::size_t>(axis)];
      return steps == 0 ? 0 : size[axis] * (static_cast<double>(step) / static_cast<double>(steps) - 0.5);
    };
    for (std::int64_t k = 0; k <= n[2]; ++k) {
      for (std::int64_t j = 0; j <= n[1]; ++j) {
        const bool onFace = k == 0 || k == n[2] || j == 0 || (j == n[1] && !openTop_);
        for (std::int64_t i = 0; i <= n[0]; ++i) {
          if (!onFace && i == 1) i = n[0];
          add({place(0, i), place(1, j), place(2, k)});
        }
      }
    }
  }

  Vector3d size_;
  bool openTop_;
};

class SphereSurface : public BodyShape {
 public:
  explicit SphereSurface(const v1::SphereShape& sphere) : radius_(sphere.radius()) {}

  Eigen::AlignedBox3d bounds() const override { return {Vector3d::Constant(-radius_), Vector3d::Constant(radius_)}; }
  bool isClosed() const override { return true; }
  bool contains(const Vector3d& x) const override { return x.norm() < radius_; }

  ClosestPoint closest(const Vector3d& x, double) const override {
    const double length = x.norm();
    const Vector3d direction = length > 0 ? Vector3d(x / length) : Vector3d::UnitY();
    return {radius_ * direction, std::abs(length - radius_)};
  }

  double area(const SurfaceSampling& sampling) const override {
    double total = 0;
    for (int layer = 0; layer < fittingLayers(sampling, 2 * radius_); ++layer) {
      const double r = radius_ - depthOf(layer, sampling);
      total += 2 * kTurn * r * r;
    }
    return total;
  }

  /// Rings at even polar angles, the first and last half a step from the poles: the same above and below.
  void sample(const SurfaceSampling& sampling, const AddPoint& add) const override {
    for (int layer = 0; layer < fittingLayers(sampling, 2 * radius_); ++layer) {
      const double r = std::max(0.0, radius_ - depthOf(layer, sampling));
      const std::int64_t rings = std::max<std::int64_t>(1, std::llround(0.5 * kTurn * r / sampling.spacing));
      for (std::int64_t ring = 0; ring < rings; ++ring) {
        const double polar = 0.5 * kTurn * (static_cast<double>(ring) + 0.5) / static_cast<double>(rings);
        sampleRing(r * std::sin(polar), r * std::cos(polar), sampling.spacing, add);
      }
    }
  }

 private:
  double radius_;
};

class CylinderSurface : public BodyShape {
 public:
  explicit CylinderSurface(const v1::CylinderShape& cylinder)
      : radius_(cylinder.radius()), half_(0.5 * cylinder.height()), openTop_(cylinder.open_top()) {}

  Eigen::AlignedBox3d bounds() const override {
    return {Vector3d(-radius_, -half_, -radius_), Vector3d(radius_, half_, radius_)};
  }
  bool isClosed() const override { return !openTop_; }
  bool contains(const Vector3d& x) const override {
    return isClosed() && std::abs(x.y()) < half_ && std::hypot(x.x(), x.z()) < radius_;
  }

  ClosestPoint closest(const Vector3d& x, double) const override {
    const double fromAxis = std::hypot(x.x(), x.z());
    const Vector3d outward = fromAxis > 0 ? Vector3d(x.x() / fromAxis, 0, x.z() / fromAxis) : Vector3d::UnitX();
    ClosestPoint best;
    const auto consider = [&](double radius, double y) {
      const Vector3d point = radius * outward + y * Vector3d::UnitY();
      const double distance = (x - point).norm();
      if (distance < best.distance) best = {point, distance};
    };
    consider(radius_, std::clamp(x.y(), -half_, half_));
    consider(std::min(fromAxis, radius_), -half_);
    if (!openTop_) consider(std::min(fromAxis, radius_), half_);
    return best;
  }

  double area(const SurfaceSampling& sampling) const override {
    double total = 0;
    for (int layer = 0; layer < layersOf(sampling); ++layer) {
      const double r = radius_ - depthOf(layer, sampling);
      const double height = 2 * (half_ - depthOf(layer, sampling));
      total += kTurn * r * height + (openTop_ ? 0.5 : 1.0) * kTurn * r * r;
    }
    return total;
  }

  void sample(const SurfaceSampling& sampling, const AddPoint& add) const override {
    for (int layer = 0; layer < layersOf(sampling); ++layer) {
      const double inset = depthOf(layer, sampling);
      sampleShell(std::max(0.0, radius_ - inset), std::max(0.0, half_ - inset), sampling.spacing, add);
    }
  }

 private:
  int layersOf(const SurfaceSampling& sampling) const {
    return openTop_ ? 1 : fittingLayers(sampling, 2 * std::min(radius_, half_));
  }

  /// A mantle with both its rims, and lids within them; a cylinder lower than half a spacing is one disc.
  void sampleShell(double radius, double half, double spacing, const AddPoint& add) const {
    const std::int64_t rows = std::llround(2 * half / spacing);
    for (std::int64_t row = 0; row <= rows; ++row) {
      const double y = rows == 0 ? 0 : half * (2 * static_cast<double>(row) / static_cast<double>(rows) - 1);
      sampleRing(radius, y, spacing, add);
      if (row == 0 || (row == rows && !openTop_)) sampleLid(radius, y, spacing, add);
    }
  }

  static void sampleLid(double radius, double y, double spacing, const AddPoint& add) {
    const std::int64_t rings = std::llround(radius / spacing);
    for (std::int64_t ring = 0; ring < rings; ++ring) {
      sampleRing(radius * static_cast<double>(ring) / static_cast<double>(rings), y, spacing, add);
    }
  }

  double radius_;
  double half_;
  bool openTop_;
};

std::unique_ptr<const BodyShape> readMesh(const v1::MeshShape& mesh, const std::string& fieldPath) {
  try {
    return std::make_unique<const MeshShape>(particleio::readMeshFile(mesh.path()), mesh.scale());
  } catch (const core::InputError& error) {
    throw core::InputError("", fieldPath + ".mesh.path", error.what());
  }
}

}  // namespace

std::unique_ptr<const BodyShape> makeBodyShape(const v1::Body& body, const std::string& fieldPath) {
  switch (body.shape_case()) {
    case v1::Body::kSphere:
      return std::make_unique<const SphereSurface>(body.sphere());
    case v1::Body::kCylinder:
      return std::make_unique<const CylinderSurface>(body.cylinder());
    case v1::Body::kMesh:
      return readMesh(body.mesh(), fieldPath);
    default:
      return std::make_unique<const BoxSurface>(body.box());
  }
}

}  // namespace sluice::solids
