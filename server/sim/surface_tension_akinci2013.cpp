#include "surface_tension_akinci2013.h"

#include <cmath>
#include <numbers>

namespace sluice::sim {

namespace {

/// C over its factor 32/(πH³), at distance qH.
double cohesion(double q) {
  const double cubed = std::pow((1 - q) * q, 3);
  return q > 0.5 ? cubed : 2 * cubed - 1.0 / 64;
}

/// ∫ q^(D+1) C(q) dq over [0, 1].
double cohesionMoment(int dimensions) {
  constexpr int kIntervals = 1000;
  double sum = 0;
  for (int k = 0; k < kIntervals; ++k) {
    const double q = (k + 0.5) / kIntervals;
    sum += std::pow(q, dimensions + 1) * cohesion(q) / kIntervals;
  }
  return sum;
}

/// Acceleration, times the rest density, of a particle by another at C = 1 for a surface tension of 1: from
/// σ = π/8 (ρ0/V) S H⁵ ∫ q⁴ C dq (1/3 (ρ0/V) S H⁴ ∫ q³ C dq in two dimensions), with S = γ m.
double forcePerTension(const Discretisation& d) {
  const double moment = cohesionMoment(d.dimensions);
  if (d.dimensions == 2) return 3 * d.volume / (std::pow(d.support, 4) * moment);
  return 8 * d.volume / (std::numbers::pi * std::pow(d.support, 5) * moment);
}

/// Weight of the curvature term over that of C = 1 in [AAT13], for water: 1/(m 32/(πH³)) in SI units.
double publishedCurvature(const Discretisation& d) {
  constexpr double kWater = 1000;
  return std::numbers::pi * std::pow(d.support / d.spacing, 3) / (32 * kWater);
}

}  // namespace

void Akinci2013Tension::apply(const v1::SurfaceTension& settings, StepContext& step) {
  const NeighbourLists& lists = step.lists;
  ParticleState& state = step.state;
  const std::size_t particles = state.size();
  const double force = settings.tension() * forcePerTension(step.discretisation) * step.seconds;
  const Cohesion cohesion{
      step.mixture.withinFluidsByDensity(state.fluid, force),
      static_cast<float>(settings.akinci2013().curvature() * publishedCurvature(step.discretisation))};

  normals_.compute(ColourGradient::Weight::Volume, step);
  places_.resize(particles);
  result_.resize(particles);
  const auto support = static_cast<float>(step.discretisation.support);
  step.team.forEachChunk(particles, [&](const Chunk& chunk) {
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      Float4& n = normals_.values()[i];
      n = {support * n.x, support * n.y, support * n.z, 0};
      const Float4& x = state.position[i];
      places_[i] = {x.x, x.y, x.z, lists.density()[i]};
    }
  });
  step.team.forEachChunk(particles, [&](const Chunk& chunk) {
    lists.loops().cohere(lists.chunk(chunk), lists.scale(), cohesion, places_.data(), normals_.values().data(),
                         state.velocity.data(), result_.data());
  });
  state.velocity.swap(result_);
}

std::uint64_t Akinci2013Tension::bytes() const {
  return normals_.bytes() + (places_.size() + result_.size()) * sizeof(Float4);
}

}  // namespace sluice::sim
