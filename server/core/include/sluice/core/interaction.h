#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace sluice::core {

/// A hand in the fluid: what a viewer does to it along a ray, for a while of simulated time.
struct Interaction {
  enum class Action : std::uint8_t {
    Push,  ///< Accelerates particles near the ray along it.
    Pull,  ///< Accelerates particles near the ray towards the point at which it first meets fluid.
    Add,   ///< Adds a ball of fluid where the ray first meets fluid, a body or a wall.
  };

  Action action = Action::Push;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();       ///< m; finite.
  Eigen::Vector3d direction = -Eigen::Vector3d::UnitZ();  ///< Of length 1.
  double radius = 0;        ///< Reach about the ray, or of the ball, m; 0: four particle spacings.
  double strength = 30;     ///< Acceleration at the ray, m/s²; falls to 0 at `radius`.
  double seconds = 0.1;     ///< Simulated time that Push and Pull act for.
  std::uint32_t fluid = 0;  ///< Of the scene's fluids, the one that Add pours.
};

}  // namespace sluice::core
