#include "quality.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "container.h"
#include "fluid_volumes.h"

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

/// A scene's blocks and what they stand in.
struct Tank {
  const Container& container;
  double formerSpacing;  ///< That the scene names, m.

  /// A block filled with particles of `spacing`.
  v1::Block refilled(const v1::Block& block, double spacing) const {
    const auto along = [&](std::size_t axis, double first, std::uint32_t count) {
      const double low = first - container.origin[axis] - 0.5 * formerSpacing;
      return layersBetween(low, low + count * formerSpacing, container.size[axis], spacing);
    };
    v1::Block next = block;
    v1::Vec3& first = *next.mutable_first_particle();
    const Layers x = along(0, first.x(), block.count_x());
    const Layers y = along(1, first.y(), block.count_y());
    first.set_x(container.origin[0] + x.first);
    first.set_y(container.origin[1] + y.first);
    next.set_count_x(x.count);
    next.set_count_y(y.count);
    if (container.plane) return next;
    const Layers z = along(2, first.z(), block.count_z());
    first.set_z(container.origin[2] + z.first);
    next.set_count_z(z.count);
    return next;
  }
};

double particlesOf(const v1::Block& block) { return double{1} * block.count_x() * block.count_y() * block.count_z(); }

double blockParticles(const v1::Fluid& fluid) {
  double particles = 0;
  for (const v1::Block& block : fluid.blocks()) particles += particlesOf(block);
  return particles;
}

double blockParticles(const v1::Simulation& simulation) {
  double particles = 0;
  for (const v1::Fluid& fluid : simulation.fluids()) particles += blockParticles(fluid);
  return particles;
}

/// Largest change of the volume of any fluid's blocks when filled at a spacing, relative.
double volumeError(const v1::Simulation& simulation, const Tank& tank, double spacing) {
  const double particleVolume = std::pow(spacing / tank.formerSpacing, tank.container.walledAxes());
  double worst = 0;
  for (const v1::Fluid& fluid : simulation.fluids()) {
    if (fluid.blocks().empty()) continue;
    double particles = 0;
    for (const v1::Block& block : fluid.blocks()) particles += particlesOf(tank.refilled(block, spacing));
    worst = std::max(worst, std::abs(particles * particleVolume / blockParticles(fluid) - 1));
  }
  return worst;
}

/// The spacing, near that for `factor` times the particles, at which blocks best keep their volume.
double spacingFor(const v1::Simulation& simulation, const Tank& tank, double factor) {
  constexpr int kSteps = 25;
  constexpr double kStep = 0.002;
  // What a percent of spacing off is worth in percent of volume: few enough to keep volumes, enough to break ties.
  constexpr double kWorth = 0.2;
  const double nominal = tank.formerSpacing * std::pow(factor, -1.0 / static_cast<double>(tank.container.walledAxes()));
  double best = nominal;
  double leastCost = volumeError(simulation, tank, nominal);
  for (int k = -kSteps; k <= kSteps; ++k) {
    const double spacing = nominal * (1 + kStep * k);
    const double cost = volumeError(simulation, tank, spacing) + kWorth * kStep * std::abs(k);
    if (cost >= leastCost) continue;
    leastCost = cost;
    best = spacing;
  }
  return best;
}

std::uint32_t asCount(double particles) {
  constexpr double kMost = 1e8;  // Of the schema.
  return static_cast<std::uint32_t>(std::clamp(std::round(particles), 1.0, kMost));
}

}  // namespace

bool refills(const v1::Scene& scene) { return particleFactor(scene.quality()) != 1; }

void checkVolumes(const v1::Simulation& simulation) {
  const Container container = containerOf(simulation);
  for (const FluidVolume& volume : fluidVolumes(simulation, container)) {
    checkClear(volume, container, simulation.particle_spacing());
  }
}

v1::Simulation atQuality(const v1::Scene& scene) {
  v1::Simulation simulation = scene.simulation();
  if (!refills(scene)) return simulation;
  const Container container = containerOf(simulation);
  const Tank tank{container, simulation.particle_spacing()};
  const double spacing = spacingFor(simulation, tank, particleFactor(scene.quality()));
  const double factor = std::pow(tank.formerSpacing / spacing, container.walledAxes());
  // What the scene allows besides its blocks; they take what they take.
  const double otherParticles = simulation.max_particles() - blockParticles(simulation);
  simulation.set_particle_spacing(spacing);
  for (v1::Fluid& fluid : *simulation.mutable_fluids()) {
    for (v1::Block& block : *fluid.mutable_blocks()) block = tank.refilled(block, spacing);
    for (v1::Emitter& emitter : *fluid.mutable_emitters()) {
      emitter.set_max_particles(asCount(emitter.max_particles() * factor));
    }
  }
  simulation.set_max_particles(asCount(blockParticles(simulation) + std::round(otherParticles * factor)));
  return simulation;
}

}  // namespace sluice::sim
