#include "hands.h"

#include <gtest/gtest.h>

#include "sluice/core/input_error.h"

namespace sluice::sim {

using core::Interaction;
using Eigen::Vector3d;

Interaction touchOf(Interaction::Action action, const Vector3d& origin, const Vector3d& direction) {
  return {.action = action, .origin = origin, .direction = direction.normalized()};
}

Interaction downInto(Interaction::Action action) { return touchOf(action, {0.3, 3, 0.4}, {0, -1, 0}); }

std::string refusal(FluidSimulation& simulation, const Interaction& interaction) {
  const ParticleState before = simulation.state();
  try {
    simulation.interact(interaction);
  } catch (const core::InputError& error) {
    EXPECT_TRUE(simulation.state() == before);
    return error.what();
  }
  ADD_FAILURE() << "was done";
  return {};
}

}  // namespace sluice::sim
