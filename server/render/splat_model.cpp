#include "splat_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "interior_particles.h"

namespace sluice::render {

namespace {

// Multiples of the density of a particle that is alone, between which a ball grows into a splat: from hardly any
// neighbour to two near ones, each of which adds a quarter at a distance of half the support.
constexpr float kAlone = 1.05F;
constexpr float kJoined = 1.5F;

/// A pair of particles is no surface yet.
constexpr std::uint16_t kLeastNeighbours = 2;

/// Largest factor of a radius [CS08].
constexpr float kLargestGrowth = 1.6F;

SplatShape shapeOf(const v1::Splats& splats) {
  switch (splats.shape_case()) {
    case v1::Splats::kEllipsoid:
      return SplatShape::Ellipsoid;
    case v1::Splats::kDisc:
      return SplatShape::Disc;
    default:
      return SplatShape::Sphere;
  }
}

std::vector<SplatRole> findRoles(const core::ParticleSnapshot& particles, const v1::Splats& splats) {
  const bool strays = splats.stray_density() > 0 && !particles.densities.empty();
  const bool interior =
      splats.skip_interior() && !particles.neighbours.empty() && splats.radius_in_spacings() >= kLeastRadiusOfInterior;
  if (!strays && !interior) return {};

  std::vector<SplatRole> roles(particles.size(), SplatRole::Surface);
  bool plain = true;
  if (interior) {
    const std::vector<char> isInterior = findInterior(particles);
    for (std::size_t i = 0; i < roles.size(); ++i) {
      if (isInterior[i] == 0) continue;
      roles[i] = SplatRole::Interior;
      plain = false;
    }
  }
  if (strays) {
    const auto least = static_cast<float>(splats.stray_density() * particles.restDensity);
    for (std::size_t i = 0; i < roles.size(); ++i) {
      // Near a wall the boundary's share of the density hides that a particle is alone.
      const bool alone = !particles.neighbours.empty() && particles.neighbours[i] < kLeastNeighbours;
      if (particles.densities[i] >= least && !alone) continue;
      roles[i] = SplatRole::Spray;
      plain = false;
    }
  }
  if (plain) return {};
  return roles;
}

void findRadii(SplatModel& model, const core::ParticleSnapshot& particles, float radius, const SplatModel& previous) {
  const auto spacing = static_cast<float>(particles.spacing);
  const auto perRestDensity = static_cast<float>(1.0 / particles.restDensity);
  const float alone = aloneDensity(particles);
  model.radii.resize(particles.size());
  for (std::size_t i = 0; i < particles.size(); ++i) {
    model.radii[i] = radiusByDensity(particles.densities[i] * perRestDensity, alone, radius, spacing);
  }
  if (particles.ids.empty()) return;
  model.radiusOfId.reserve(particles.size());
  for (std::size_t i = 0; i < particles.size(); ++i) {
    float& wanted = model.radii[i];
    const auto former = previous.radiusOfId.find(particles.ids[i]);
    if (former != previous.radiusOfId.end() && std::abs(wanted - former->second) <= kRadiusHysteresis * wanted) {
      wanted = former->second;
    }
    model.radiusOfId[particles.ids[i]] = wanted;
  }
}

}  // namespace

float aloneDensity(const core::ParticleSnapshot& particles) {
  const double ratio = particles.supportRadius > 0 ? particles.spacing / particles.supportRadius : 0.5;
  return static_cast<float>(8 / std::numbers::pi * ratio * ratio * ratio);
}

float radiusByDensity(float density, float alone, float radius, float spacing) {
  const float ball = kBallOfParticle * spacing;
  if (density <= kAlone * alone) return ball;
  const float grown = radius * std::clamp(1.0F / std::cbrt(density), 1.0F, kLargestGrowth);
  if (density >= kJoined * alone) return grown;
  return std::lerp(ball, grown, (density / alone - kAlone) / (kJoined - kAlone));
}

SplatModel makeSplatModel(const core::ParticleSnapshot& particles, const v1::Splats& splats,
                          const SplatModel& previous) {
  SplatModel model;
  model.shape = shapeOf(splats);
  model.roles = findRoles(particles, splats);
  const auto radius = static_cast<float>(splats.radius_in_spacings() * particles.spacing);
  if (splats.radius_by_density() && !particles.densities.empty()) findRadii(model, particles, radius, previous);
  if (model.shape == SplatShape::Ellipsoid) {
    model.ellipsoids = makeEllipsoids(particles.positions, static_cast<float>(particles.spacing), radius, model.radii,
                                      splats.ellipsoid());
  }
  return model;
}

}  // namespace sluice::render
