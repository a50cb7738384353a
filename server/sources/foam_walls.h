#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "sluice/core/particle_snapshot.h"
#include "sluice/solids/enclosure.h"
#include "sluice/solids/placed_body.h"
#include "sluice/v1/scene.pb.h"

namespace sluice::sources {

/// What holds the liquid, and the bodies that it flows around: near them neighbours are missing that a wall stands for,
/// not air, and secondary particles do not pass them. Const functions are thread-safe.
class FoamWalls {
 public:
  FoamWalls() = default;
  explicit FoamWalls(const Eigen::AlignedBox3f& box) : box_(box) {}

  /// The container, planes and bodies of a simulation; none of other scenes.
  explicit FoamWalls(const v1::Scene& scene);

  /// Whether there is a container that nothing leaves.
  bool areClosed() const { return box_ || enclosure_; }

  /// Puts the bodies where a snapshot has them; a snapshot that does not tell leaves them.
  void moveBodies(std::span<const core::BodyPose> poses);

  /// The share of the ball of radius h about a point that is on the liquid's side of the walls, in (0, 1], from the
  /// volumes of the caps that they cut off. A particle's own half spacing belongs to the liquid.
  float openShare(const Eigen::Vector3f& point, float support, float spacing) const;

  /// A direction without what points out through walls that are closer than h.
  Eigen::Vector3f withoutWalls(Eigen::Vector3f outward, const Eigen::Vector3f& point, float support) const;

  /// Brings what moves from `from` to `position` as far as walls let it, without the velocity that leads into them.
  void hold(const Eigen::Vector3f& from, Eigen::Vector3f& position, Eigen::Vector3f& velocity) const;

  /// Whether a point touches a wall that gravity points to.
  bool isOnGround(const Eigen::Vector3f& point, const Eigen::Vector3f& gravity) const;

 private:
  struct Obstacle {
    solids::PlacedBody body;
    std::size_t inScene;  ///< Its number there.
  };

  void holdInside(Eigen::Vector3f& position, Eigen::Vector3f& velocity) const;
  solids::ClosestPoint closestBody(const Eigen::Vector3d& point, double reach) const;

  std::optional<Eigen::AlignedBox3f> box_;
  std::optional<solids::Enclosure> enclosure_;  ///< Where it is no plain box.
  std::vector<Obstacle> obstacles_;
  double clearance_ = 0;  ///< That is kept from bodies, m.
};

}  // namespace sluice::sources
