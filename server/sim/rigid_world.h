#pragma once

#include <memory>
#include <vector>

#include <Eigen/Geometry>

#include "container.h"
#include "sluice/solids/body_shape.h"
#include "sluice/v1/scene.pb.h"

namespace sluice::sim {

/// Where a body is and how it moves.
struct RigidState {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();                       ///< Of the centre of mass, m.
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();             ///< Of its own axes.
  Eigen::Matrix<double, 6, 1> twist = Eigen::Matrix<double, 6, 1>::Zero();  ///< Velocity, m/s, and spin, rad/s.
};

/// What the dynamics needs to know of one body.
struct RigidPart {
  const v1::Body* settings = nullptr;
  const solids::BodyShape* shape = nullptr;
  double mass = 0;  ///< kg; 0 where nothing but its driver, or nothing at all, moves it.
  Eigen::Vector3d centreOfMass = Eigen::Vector3d::Zero();
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  bool collides = true;
  RigidState start;  ///< Where it stays, of those that stand.
};

/// Rigid bodies that meet each other, the container and its planes, by Bullet (Coumans et al.). Floating meshes
/// collide as their convex hulls. The world is made anew in every step: what Bullet would carry on of contacts has no
/// part in the next one, so that poses and velocities are the whole state. Deterministic. Thread-safe.
class RigidWorld {
 public:
  /// The parts that move, and after them those that stand.
  RigidWorld(const std::vector<RigidPart>& parts, const Container& container, double spacing);
  ~RigidWorld();
  RigidWorld(const RigidWorld&) = delete;
  RigidWorld& operator=(const RigidWorld&) = delete;

  /// Moves those of the first parts, whose states are given, that have a mass by `seconds`; the others among them are
  /// where `states` has them and move with their velocities.
  void step(std::vector<RigidState>& states, double seconds) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace sluice::sim
