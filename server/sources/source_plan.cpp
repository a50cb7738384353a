#include "source_plan.h"

namespace sluice::sources {

core::Plan planOfStored(const particleio::ParticleFileData& particles) {
  core::Plan plan;
  const auto addBuffer = [&](const char* name, std::size_t bytes) {
    if (bytes > 0) plan.buffers.push_back({name, bytes});
  };
  addBuffer("positions", particles.positions.size() * sizeof(Eigen::Vector3f));
  addBuffer("velocities", particles.velocities.size() * sizeof(Eigen::Vector3f));
  addBuffer("densities", particles.densities.size() * sizeof(float));
  addBuffer("ids", particles.ids.size() * sizeof(std::uint32_t));
  addBuffer("pressures", particles.pressures.size() * sizeof(float));
  addBuffer("fluids", particles.fluids.size());
  plan.leftOut = {{"neighbour search", "the particles are stored, not simulated"},
                  {"pressure solve", "the particles are stored, not simulated"}};
  return plan;
}

}  // namespace sluice::sources
