#include "quality.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "container.h"

namespace sluice::sim {

namespace {

/// Particles for one of the scene's own.
double particleFactor(const std::string& quality) {
  if (quality == "draft") return 1.0 / 3;
  return quality == "fine" ? 3 : 1;
}

/// The layers of a lattice of `spacing` that fill [low, high], m, of a box `size` long.
struct Layers {
  double first;
  std::uint32_t count;
};

Layers layersBetween(double low, double high, double size, double spacing) {
  // Layers lie at 1, 2, … spacings from the lower face of the box, the planes between them half-way.
  const auto planeAt = [&](double position) { return std::round(position / spacing - 0.5); };
  const double last = std::max(1.0, std::floor(size / spacing - 1 + 1e-9));
  const double below = std::clamp(planeAt(low), 0.0, last - 1);
  const double above = std::clamp(planeAt(high), below + 1, last);
  return {(below + 1) * spacing, static_cast<std::uint32_t>(above - below)};
}

void refill(v1::Block& block, const Container& container, double formerSpacing, double spacing) {
  const auto along = [&](std::size_t axis, double first, std::uint32_t count) {
    const double low = first - container.origin[axis] - 0.5 * formerSpacing;
    return layersBetween(low, low + count * formerSpacing, container.size[axis], spacing);
  };
  v1::Vec3& first = *block.mutable_first_particle();
  const Layers x = along(0, first.x(), block.count_x());
  const Layers y = along(1, first.y(), block.count_y());
  first.set_x(container.origin[0] + x.first);
  first.set_y(container.origin[1] + y.first);
  block.set_count_x(x.count);
  block.set_count_y(y.count);
  if (container.plane) return;
  const Layers z = along(2, first.z(), block.count_z());
  first.set_z(container.origin[2] + z.first);
  block.set_count_z(z.count);
}

std::uint32_t scaled(std::uint32_t particles, double factor) {
  constexpr double kMost = 1e8;  // Of the schema.
  return static_cast<std::uint32_t>(std::clamp(std::round(particles * factor), 1.0, kMost));
}

}  // namespace

v1::Simulation atQuality(const v1::Scene& scene) {
  v1::Simulation simulation = scene.simulation();
  const double factor = particleFactor(scene.quality());
  if (factor == 1) return simulation;
  const Container container = containerOf(simulation);
  const double former = simulation.particle_spacing();
  const double spacing = former * std::pow(factor, simulation.planar() ? -1.0 / 2 : -1.0 / 3);
  simulation.set_particle_spacing(spacing);
  simulation.set_max_particles(scaled(simulation.max_particles(), factor));
  for (v1::Fluid& fluid : *simulation.mutable_fluids()) {
    for (v1::Block& block : *fluid.mutable_blocks()) refill(block, container, former, spacing);
    for (v1::Emitter& emitter : *fluid.mutable_emitters()) {
      emitter.set_max_particles(scaled(emitter.max_particles(), factor));
    }
  }
  return simulation;
}

}  // namespace sluice::sim
