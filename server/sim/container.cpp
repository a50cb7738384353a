#include "container.h"

#include <sstream>
#include <string>

#include "sluice/core/input_error.h"

namespace sluice::sim {

namespace {

std::array<double, 3> toTriple(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

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

/// The field that a container's width is told by.
std::string sizeField(const v1::Simulation& simulation) {
  if (simulation.has_spherical_container()) return "simulation.spherical_container.radius";
  if (simulation.has_cylindrical_container()) return "simulation.cylindrical_container";
  return "simulation.container.max";
}

}  // namespace

Container containerOf(const v1::Simulation& simulation) {
  const solids::Enclosure enclosure(simulation);
  Container container{toTriple(enclosure.bounds().min()), toTriple(enclosure.bounds().sizes()), {}};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (container.size[axis] >= 2 * kClearance * simulation.particle_spacing()) continue;
    std::ostringstream problem;
    problem << "the container is " << container.size[axis] << " m long in " << kAxes[axis]
            << "; it must be at least two particle spacings, " << 2 * simulation.particle_spacing() << " m";
    throw core::InputError("", sizeField(simulation), problem.str());
  }
  if (!enclosure.isBox()) {
    if (simulation.planar()) {
      throw core::InputError("", "simulation.planar", "a planar scene's container has to be a box without planes");
    }
    container.enclosure = enclosure.relativeTo(enclosure.bounds().min());
  }
  if (simulation.planar()) container.plane = planeOf(simulation) - container.origin[2];
  return container;
}

}  // namespace sluice::sim
