#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "particles.h"
#include "sluice/core/state_stream.h"
#include "team.h"

namespace sluice::sim {

/// A half-line in the container's coordinates.
struct TouchRay {
  Eigen::Vector3d origin;     ///< m.
  Eigen::Vector3d direction;  ///< Of length 1.

  Eigen::Vector3d at(double distance) const { return origin + distance * direction; }
};

/// What a hand does to the particles around a ray for a while: the acceleration a (1 - (r/R)²)² at a distance r < R
/// from it, the weight of Lucy 1977 without its slope at the edge. Numbers alone, without padding: saved as they are.
struct TouchForce {
  std::array<double, 3> origin{};     ///< Of the ray, m.
  std::array<double, 3> direction{};  ///< Of the ray, of length 1.
  /// Of a push: the unit vector that it acts along. Of a pull: the point that it acts towards, m.
  std::array<double, 3> aim{};
  double radius = 0;        ///< R, m.
  double acceleration = 0;  ///< a, m/s².
  double end = 0;           ///< Simulated time at which it ends, s.
  std::uint64_t pulls = 0;  ///< 1 for a pull, 0 for a push.

  bool operator==(const TouchForce&) const = default;
};

/// The hands in the fluid. A force acts for exactly its time, however steps fall: one that ends within a step gives
/// that share of the step's change of velocity. Used by one thread; loops run on the team, and what they compute does
/// not depend on its size.
class Touch {
 public:
  /// `softening`: nearer to the point that it acts towards, m, a pull weakens in proportion to the distance, so that
  /// particles do not shoot past it.
  explicit Touch(double softening) : softening_(softening) {}

  void reset() { forces_.clear(); }

  /// Throws core::InputError where more forces act already than hands could be meant.
  void add(const TouchForce& force);

  /// Whether any acts after `time`, s.
  bool isActive(double time) const;

  /// Bound on the acceleration of any particle, m/s².
  double largestAcceleration(double time) const;

  /// Changes velocities by what acts from `time` to `end`, s. Returns the momentum that this gives
  /// per volume of a particle, kg/(m² s), for the rest densities of the fluids, kg/m³.
  Eigen::Vector3d apply(ParticleState& particles, double time, double end, const std::vector<double>& restDensities,
                        const Team& team) const;

  /// Forgets what has ended by `time`, s.
  void expire(double time);

  void save(core::StateWriter& out) const;

  /// Throws InputError where a force is none.
  void resume(core::StateReader& in);

 private:
  double softening_;
  std::vector<TouchForce> forces_;
};

}  // namespace sluice::sim
