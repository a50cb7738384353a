#pragma once

#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "sluice/v1/scene.pb.h"

namespace sluice::solids {

/// The convex region that a simulation's container and planes leave to the fluid, with the exact distance to each of
/// its faces: those of a box or an upright cylinder's ends, further planes, and a sphere or a cylinder's mantle.
/// Immutable; all functions are thread-safe.
class Enclosure {
 public:
  struct Plane {
    Eigen::Vector3d normal;  ///< Unit, towards the fluid.
    double offset = 0;       ///< normal·x on the plane, m.
  };

  /// Within this distance of its axis, or of its middle.
  struct Round {
    Eigen::Vector3d centre;
    double radius = 0;
    bool isUpright = false;  ///< A cylinder along y; otherwise a sphere.
  };

  /// Throws core::InputError where a plane leaves nothing of the container.
  explicit Enclosure(const v1::Simulation& simulation);

  /// The same region about another origin.
  Enclosure relativeTo(const Eigen::Vector3d& origin) const;

  /// Of the container, planes left aside.
  const Eigen::AlignedBox3d& bounds() const { return bounds_; }

  /// Whether it is a box without further planes.
  bool isBox() const { return !round_ && planes_.size() == kFacesOfBox; }

  const std::vector<Plane>& planes() const { return planes_; }
  const std::optional<Round>& round() const { return round_; }
  std::size_t ownPlanes() const { return ownPlanes_; }  ///< The container's; the scene's planes follow them.

  /// Calls `visit(normal, distance)` for every face with its unit normal at the point closest to `x`, towards the
  /// fluid, and the distance of `x` in front of it, m, negative behind it.
  template <class Visit>
  void forEachFace(const Eigen::Vector3d& x, Visit&& visit) const {
    for (const Plane& plane : planes_) visit(plane.normal, plane.normal.dot(x) - plane.offset);
    if (!round_) return;
    Eigen::Vector3d inward = round_->centre - x;
    if (round_->isUpright) inward.y() = 0;
    const double fromCentre = inward.norm();
    visit(fromCentre > 0 ? Eigen::Vector3d(inward / fromCentre) : Eigen::Vector3d::UnitX().eval(),
          round_->radius - fromCentre);
  }

  /// How far the nearest face is from a point within, m; negative outside.
  double distance(const Eigen::Vector3d& x) const;

  /// Puts a point that is nearer to a face than `clearance` there, and takes the part out of its velocity that leads
  /// out. Returns whether it had to.
  bool hold(Eigen::Vector3d& x, Eigen::Vector3d& velocity, double clearance) const;

 private:
  static constexpr std::size_t kFacesOfBox = 6;

  std::vector<Plane> planes_;
  std::optional<Round> round_;
  std::size_t ownPlanes_ = 0;
  Eigen::AlignedBox3d bounds_;
};

}  // namespace sluice::solids
