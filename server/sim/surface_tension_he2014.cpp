#include "surface_tension_he2014.h"

#include <cmath>
#include <numbers>

namespace sluice::sim {

namespace {

/// H ∫ (dc/dz)² dz of a half-space smoothed by the kernel: dc/dz is the kernel's integral over the plane at height z.
double surfaceEnergy(const Discretisation& d) {
  constexpr int kIntervals = 200;
  return withKernel(d.kernel, [&]<class Kernel>(Kernel) {
    const auto planeIntegral = [&](double z) {
      const double radius = std::sqrt(1 - z * z);
      double sum = 0;
      for (int k = 0; k < kIntervals; ++k) {
        const double x = radius * (k + 0.5) / kIntervals;
        const double measure = d.dimensions == 2 ? 2 : 2 * std::numbers::pi * x;
        sum += measure * kernelValue<Kernel>(std::sqrt(x * x + z * z), 1, d.dimensions) * radius / kIntervals;
      }
      return sum;
    };
    double energy = 0;
    for (int k = 0; k < kIntervals; ++k) {
      const double slope = planeIntegral((k + 0.5) / kIntervals);
      energy += 2 * slope * slope / kIntervals;
    }
    return energy;
  });
}

}  // namespace

void He2014Tension::apply(const v1::SurfaceTension& settings, StepContext& step) {
  const NeighbourLists& lists = step.lists;
  ParticleState& state = step.state;
  const std::size_t particles = state.size();
  const Discretisation& d = step.discretisation;
  const double energyCoefficient = 2 * settings.tension() * d.support / surfaceEnergy(d);  // κ, N.
  const auto scale = static_cast<float>(-energyCoefficient * step.seconds / (4 * step.mixture.heaviest()));

  colour_.compute(ColourGradient::Weight::Density, step);
  impulse4_.resize(particles);
  result_.resize(particles);
  step.team.forEachChunk(particles, [&](const Chunk& chunk) {
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      const Float4& g = colour_.values()[i];
      const float density = lists.density()[i];
      const float k = scale * (g.x * g.x + g.y * g.y + g.z * g.z) / (density * density);
      impulse4_[i] = {k, k, k, k};
    }
  });
  const Mobility mobility = step.mixture.mobility(state.fluid);
  step.team.forEachChunk(particles, [&](const Chunk& chunk) {
    lists.loops().applyImpulses(lists.chunk(chunk), mobility, impulse4_.data(), colour_.ofFluid().data(),
                                state.velocity.data(), result_.data());
  });
  state.velocity.swap(result_);
}

std::uint64_t He2014Tension::bytes() const {
  return colour_.bytes() + (impulse4_.size() + result_.size()) * sizeof(Float4);
}

}  // namespace sluice::sim
