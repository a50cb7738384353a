#include "sluice/sim/simulation.h"

#include "fluid_simulation.h"
#include "quality.h"
#include "sluice/core/input_error.h"

namespace sluice::sim {

std::unique_ptr<core::ParticleSource> makeSimulation(const v1::Scene& scene, int threads,
                                                     std::uint64_t mostParticles) {
  if (!scene.has_simulation()) throw core::InputError("", "simulation", "the scene has no simulation");
  return std::make_unique<FluidSimulation>(atQuality(scene), scene.bodies(),
                                           SimulationOptions{.threads = threads, .mostParticles = mostParticles});
}

}  // namespace sluice::sim
