#include "sluice/sim/experiment.h"

#include <sstream>

#include "experiment_state.h"
#include "fluid_simulation.h"
#include "sluice/core/input_error.h"

namespace sluice::sim {

namespace {

[[noreturn]] void refuse(const char* what, std::size_t particle, const std::string& problem) {
  throw core::InputError("", std::string("experiment.") + what + "[" + std::to_string(particle) + "]", problem);
}

void checkPosition(const Eigen::Vector3d& place, std::size_t particle, const Container& container) {
  // Not finite numbers are not inside either.
  const bool inside = (place.array() >= 0).all() && place[0] <= container.size[0] && place[1] <= container.size[1] &&
                      place[2] <= container.size[2];
  if (!inside) refuse("positions", particle, "must be inside of the container");
  if (container.plane && place[2] != *container.plane) refuse("positions", particle, "must lie in the scene's plane");
}

}  // namespace

void checkPeriod(const Container& container, double support) {
  // What a search looks through is three cells wide, none of which may be there twice.
  constexpr double kSupports = 3.1;
  const std::array<double, 3> period = container.period();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (period[axis] == 0 || period[axis] >= kSupports * support) continue;
    std::ostringstream problem;
    problem << "a periodic container must be " << kSupports << " supports long, " << kSupports * support << " m";
    throw core::InputError("", "simulation.container.max", problem.str());
  }
}

ParticleState stateOf(const Experiment& experiment, const Container& container) {
  const Eigen::Vector3d origin(container.origin[0], container.origin[1], container.origin[2]);
  if (!experiment.velocities.empty() && experiment.velocities.size() != experiment.positions.size()) {
    throw core::InputError("", "experiment.velocities", "must be as many as there are positions");
  }
  ParticleState state;
  for (std::size_t i = 0; i < experiment.positions.size(); ++i) {
    const Eigen::Vector3d place = experiment.positions[i] - origin;
    checkPosition(place, i, container);
    state.position.push_back(
        {static_cast<float>(place[0]), static_cast<float>(place[1]), static_cast<float>(place[2]), 0});
    Eigen::Vector3d v = Eigen::Vector3d::Zero();
    if (!experiment.velocities.empty()) v = experiment.velocities[i];
    if (!v.allFinite() || (container.plane && v[2] != 0)) {
      refuse("velocities", i, container.plane ? "must be finite, and 0 in z" : "must be finite");
    }
    state.velocity.push_back({static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2]), 0});
    state.id.push_back(static_cast<std::uint32_t>(i));
  }
  state.densityImpulse.resize(state.size());
  return state;
}

std::unique_ptr<core::ParticleSource> makeExperiment(const v1::Scene& scene, Experiment experiment, int threads) {
  if (!scene.has_simulation()) throw core::InputError("", "simulation", "the scene has no simulation");
  return std::make_unique<FluidSimulation>(
      scene.simulation(),
      SimulationOptions{.threads = threads, .experiment = std::make_shared<const Experiment>(std::move(experiment))});
}

}  // namespace sluice::sim
