#include "container.h"

#include <sstream>

#include "sluice/core/input_error.h"

namespace sluice::sim {

namespace {

std::array<double, 3> toTriple(const v1::Vec3& v) { return {v.x(), v.y(), v.z()}; }

constexpr char kAxes[] = "xyz";

/// Height of what the first fluid starts as; 0 where there is none, which is refused elsewhere.
double planeOf(const v1::Simulation& simulation) {
  for (const v1::Fluid& fluid : simulation.fluids()) {
    for (const v1::Block& block : fluid.blocks()) return block.first_particle().z();
    for (const v1::Ball& ball : fluid.balls()) return ball.centre().z();
    for (const v1::Emitter& emitter : fluid.emitters()) return emitter.position().z();
  }
  return 0;
}

}  // namespace

Container containerOf(const v1::Simulation& simulation) {
  const std::array<double, 3> low = toTriple(simulation.container().min());
  const std::array<double, 3> high = toTriple(simulation.container().max());
  Container container{low, {}, {}};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    container.size[axis] = high[axis] - low[axis];
    if (container.size[axis] >= 2 * kClearance * simulation.particle_spacing()) continue;
    std::ostringstream problem;
    problem << "the container is " << container.size[axis] << " m long in " << kAxes[axis]
            << "; it must be at least two particle spacings, " << 2 * simulation.particle_spacing() << " m";
    throw core::InputError("", "simulation.container.max", problem.str());
  }
  if (simulation.planar()) container.plane = planeOf(simulation) - container.origin[2];
  return container;
}

}  // namespace sluice::sim
