#include "stability/body_cases.h"

#include <algorithm>
#include <cmath>

namespace sluice::evaluate {

namespace {

constexpr double kSpacing = 0.05;
constexpr double kEdge = 0.2;     ///< Of every body, a cube, m.
constexpr double kSurface = 0.4;  ///< Height of the water, m.
constexpr double kWater = 1000;   ///< kg/m³.

void set(v1::Vec3& vector, double x, double y, double z) {
  vector.set_x(x);
  vector.set_y(y);
  vector.set_z(z);
}

v1::Body cube(double x, double y, double density) {
  v1::Body body;
  set(*body.mutable_position(), x, y, 0.25);
  set(*body.mutable_box()->mutable_size(), kEdge, kEdge, kEdge);
  body.mutable_floating()->set_density(density);
  return body;
}

/// A tank of 1 m × 1.2 m × 0.5 m with water and bodies in it. The fluid makes way for bodies that start in it.
Trial pool(std::vector<v1::Body> bodies) {
  constexpr double kHeight = 1.2;
  Trial trial;
  trial.isExperiment = false;
  trial.bodies = std::move(bodies);
  v1::Simulation& simulation = trial.simulation;
  simulation.set_particle_spacing(kSpacing);
  simulation.mutable_gravity()->set_y(-9.81);
  simulation.mutable_container()->mutable_min()->set_x(0);
  set(*simulation.mutable_container()->mutable_max(), 1, kHeight, 0.5);
  v1::Block& water = *simulation.add_fluids()->add_blocks();
  set(*water.mutable_first_particle(), kSpacing, kSpacing, kSpacing);
  water.set_count_x(19);
  water.set_count_y(static_cast<std::uint32_t>(std::lround(kSurface / kSpacing)));
  water.set_count_z(9);
  // What the water gives by falling into the hole of a body, or flowing level, at most; what the bodies give by falling
  // to the floor, or letting water down in their place.
  constexpr double kGravity = 9.81;
  double energy = kGravity * 0.1;
  const double mass = kWater * std::pow(kSpacing, 3) * 19 * 9 * std::lround(kSurface / kSpacing);
  for (const v1::Body& body : trial.bodies) {
    const double weight = std::max(body.floating().density(), kWater) * std::pow(kEdge, 3) * kGravity;
    energy += weight * std::max(body.position().y(), kSurface) / mass;
  }
  trial.energyLimit = energy;
  trial.seconds = 0.5;
  trial.steps = 5000;
  return trial;
}

}  // namespace

std::vector<StabilityJob> bodyJobs(int threads) {
  constexpr double kLight = 10;
  constexpr double kHeavy = 1000 * kLight;
  constexpr double kOnFloor = 0.5 * kEdge + 0.5 * kSpacing;
  constexpr double kOnTop = kOnFloor + kEdge + 0.2 * kSpacing;
  const std::vector<std::pair<std::string, std::vector<v1::Body>>> cases{
      {"a body 1000 times as heavy as water", {cube(0.5, kSurface + kEdge, 1000 * kWater)}},
      {"a body 1000 times as light as water, let go at the bottom", {cube(0.5, kOnFloor, 1e-3 * kWater)}},
      {"bodies of mass ratio 1000, side by side", {cube(0.25, kSurface, kLight), cube(0.75, kSurface, kHeavy)}},
      {"bodies of mass ratio 1000, the heavy one on the light one",
       {cube(0.5, kOnFloor, kLight), cube(0.5, kOnTop, kHeavy)}},
      {"bodies of mass ratio 1000, the light one on the heavy one",
       {cube(0.5, kOnFloor, kHeavy), cube(0.5, kOnTop, kLight)}}};
  std::vector<StabilityJob> jobs;
  for (const auto& [name, bodies] : cases) addForEverySolver(jobs, name, pool(bodies), threads);
  return jobs;
}

}  // namespace sluice::evaluate
