#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bodies.h"
#include "container.h"
#include "discretisation.h"
#include "rigid_world.h"
#include "sluice/core/particle_snapshot.h"
#include "sluice/core/state_stream.h"
#include "sluice/solids/placed_body.h"
#include "sluice/v1/scene.pb.h"

namespace sluice::sim {

/// Change of momentum and of angular momentum about the centre of mass, or a velocity and an angular velocity.
using Vector6d = Eigen::Matrix<double, 6, 1>;

/// A vector for each body.
struct BodySums {
  std::vector<Vector6d> ofBody;
  BodySums& operator+=(const BodySums& other);
};

/// What particles that are held at bodies hand on to them.
struct BodyPush {
  double particleMass = 0;  ///< Of the particle that is moved now, kg.
  BodySums momenta;
};

/// The bodies that fluid feels the motion of: driven ones, floating ones, and those that it rubs against. Positions are
/// relative to the container's lower corner. Used by one thread; const functions are thread-safe.
class MovingBodies {
 public:
  MovingBodies() = default;

  /// Throws core::InputError, under the body's field path, where one cannot float.
  MovingBodies(const Bodies::List& bodies, const Container& container, const Discretisation& discretisation,
               int layers);

  bool empty() const { return bodies_.empty(); }
  std::size_t size() const { return bodies_.size(); }
  bool anyMoves() const { return anyMoves_; }
  bool anyFloats() const { return anyFloats_; }
  bool anyRubs() const { return anyRubs_; }
  bool anyAdheres() const { return anyAdheres_; }

  /// Back to where the scene puts them.
  void reset();

  /// Gives driven bodies the velocities that take them along their ways from `time` in a step of `seconds`.
  void drive(double time, double seconds);

  /// Changes the velocities of floating bodies, m/s.
  void accelerate(const Eigen::Vector3d& change);

  /// Moves on by a step: driven bodies to where they are at time + seconds, floating ones as Bullet does.
  void advance(double time, double seconds);

  /// What has been moved past a body has been dealt with: from here on it stands.
  void settle();

  /// Largest speed of any point of their surfaces until `time` + `seconds`, m/s.
  double largestSpeed(double time, double seconds) const;

  const solids::PlacedBody& body(std::size_t k) const { return bodies_[k].body; }
  bool isSolid(std::size_t k) const { return bodies_[k].holdsFluid; }
  bool floats(std::size_t k) const { return bodies_[k].mass > 0; }
  double friction(std::size_t k) const { return bodies_[k].friction; }
  double adhesion(std::size_t k) const { return bodies_[k].settings.adhesion(); }  ///< N/m.
  const solids::SurfaceSampling& sampling(std::size_t k) const { return bodies_[k].sampling; }
  const Eigen::Vector3d& centre(std::size_t k) const { return state_[k].position; }

  const Vector6d& twist(std::size_t k) const { return state_[k].twist; }
  void setTwist(std::size_t k, const Vector6d& twist) { state_[k].twist = twist; }

  /// Mass and inertia of a floating body as it is turned now, as one matrix; its inverse.
  Eigen::Matrix<double, 6, 6> massMatrix(std::size_t k) const;
  Eigen::Matrix<double, 6, 6> inverseMass(std::size_t k) const;

  /// Where a particle that moves from `x` to `to` gets, while the bodies move from where they were: none passes through
  /// a surface. Takes the part out of its velocity that leads into one, and hands that momentum on to the
  /// body. Returns whether one was in its way.
  bool deflect(const Eigen::Vector3d& x, Eigen::Vector3d& velocity, Eigen::Vector3d& to, double clearance,
               BodyPush& push) const;

  /// Gives floating bodies these momenta.
  void push(const BodySums& momentum);

  /// Whether a point lies in one that holds fluid, where it is now, or nearer to its surface than `distance`.
  bool anyAt(const Eigen::Vector3d& x, double distance) const;

  /// Whether a point is nearer to one of their bounds than `reach`.
  bool near(const Eigen::Vector3d& x, double reach) const;

  /// Where every body of the scene is, for pictures; empty where none moves.
  std::vector<core::BodyPose> poses() const;

  /// What a step may be taken back to.
  using State = std::vector<RigidState>;
  const State& state() const { return state_; }
  void restore(const State& state);

  void save(core::StateWriter& out) const;
  void resume(core::StateReader& in);

 private:
  struct Moving {
    solids::PlacedBody body;
    Eigen::Isometry3d before;  ///< Its pose at the step's beginning.
    v1::Body settings;
    solids::SurfaceSampling sampling;
    std::size_t inScene = 0;
    bool holdsFluid = true;
    double friction = 0;
    double mass = 0;                                         ///< kg; 0 where it does not float.
    Eigen::Vector3d centreOfMass = Eigen::Vector3d::Zero();  ///< In its own axes.
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();       ///< In its own axes, kg m².
    double radius = 0;                                       ///< Of a ball about the centre of mass around it.
  };

  Eigen::Isometry3d wayOf(const Moving& body, double time) const;
  Eigen::Isometry3d startingPose(const v1::Body& body) const;
  void place(std::size_t k);

  std::vector<Moving> bodies_;
  State state_;
  std::vector<core::BodyPose> scenePoses_;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  bool anyMoves_ = false;
  bool anyFloats_ = false;
  bool anyRubs_ = false;
  bool anyAdheres_ = false;
  std::shared_ptr<const RigidWorld> world_;  ///< Null where none floats.
};

}  // namespace sluice::sim
