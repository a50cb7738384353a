#include "sluice/sim/simulation.h"

#include "fluid_simulation.h"
#include "quality.h"
#include "sluice/core/input_error.h"

namespace sluice::sim {

std::unique_ptr<core::ParticleSource> makeSimulation(const v1::Scene& scene, int threads, std::uint64_t mostParticles) {
  if (!scene.has_simulation()) throw core::InputError("", "simulation", "the scene has no simulation");
  SimulationOptions options{.threads = threads, .mostParticles = mostParticles};
  if (refills(scene)) {
    checkVolumes(scene.simulation());
    options.volumeFit = VolumeFit::Refilled;
  }
  return std::make_unique<FluidSimulation>(atQuality(scene), scene.bodies(), options);
}

}  // namespace sluice::sim
