// What a viewer's hand does to a FluidSimulation.

#include <algorithm>
#include <cmath>
#include <sstream>

#include "added_ball.h"
#include "fluid_simulation.h"
#include "sluice/core/input_error.h"
#include "touch_ray.h"

namespace sluice::sim {

namespace {

using Action = core::Interaction::Action;
using Eigen::Vector3d;

/// What a hand reaches that does not say how far, in spacings.
constexpr double kUsualReach = 4;

/// A direction with less than this part in a plane, or out of it, has none.
constexpr double kLeastPart = 1e-6;

[[noreturn]] void refuse(const std::string& field, const std::string& problem) {
  throw core::InputError("", field.empty() ? "interact" : "interact." + field, problem);
}

void check(const core::Interaction& interaction) {
  if (!interaction.origin.allFinite()) refuse("origin", "must be finite");
  if (!interaction.direction.allFinite() || interaction.direction.isZero(0)) {
    refuse("direction", "must be finite and have a length");
  }
  const auto checkAmount = [](double value, const char* field) {
    if (!std::isfinite(value) || value < 0) refuse(field, std::to_string(value) + " must be finite and not negative");
  };
  checkAmount(interaction.radius, "radius");
  checkAmount(interaction.strength, "strength");
  checkAmount(interaction.seconds, "seconds");
}

std::array<double, 3> toArray(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

/// A hand that has come to a scene's container.
struct Hand {
  TouchRay ray;
  /// Of a planar scene: where the ray passes through its plane; none where it lies in it.
  std::optional<Vector3d> crossing = std::nullopt;
};

/// In a planar scene, a ray that comes from outside of the plane reaches what is around the point at which it passes
/// through it, as it is seen; one that does not get there is projected on it.
Hand handOf(const core::Interaction& interaction, const Container& container) {
  Hand hand{{interaction.origin - Vector3d::Map(container.origin.data()), interaction.direction.normalized()}};
  if (!container.plane) return hand;
  TouchRay& ray = hand.ray;
  const double slope = ray.direction.z();
  const double along = (*container.plane - ray.origin.z()) / slope;
  if (std::abs(slope) > kLeastPart && along >= 0) {
    hand.crossing = ray.at(along);
    hand.crossing->z() = *container.plane;
    return hand;
  }
  ray.origin.z() = *container.plane;
  ray.direction.z() = 0;
  if (ray.direction.norm() < kLeastPart) refuse("direction", "leads away from the scene's plane");
  ray.direction.normalize();
  return hand;
}

Vector3d pushDirection(const Hand& hand, const Container& container) {
  Vector3d direction = hand.ray.direction;
  if (!container.plane) return direction;
  direction.z() = 0;
  if (direction.norm() < kLeastPart) refuse("direction", "has no part in the scene's plane, which a push acts in");
  return direction.normalized();
}

std::string reasonForNoPlace(const BallPlaces& places) {
  std::ostringstream problem;
  problem << "no particle fits where the ray ends: of the ball's " << places.byFluid + places.bySolids << " places, "
          << places.byFluid << " are nearer than 0.9 spacings to the fluid, and " << places.bySolids
          << " are in a wall or a body or too near to one";
  return problem.str();
}

}  // namespace

std::vector<const solids::PlacedBody*> FluidSimulation::presentBodies() const {
  std::vector<const solids::PlacedBody*> present = bodies_.standing();
  for (std::size_t k = 0; k < movingBodies_.size(); ++k) present.push_back(&movingBodies_.body(k));
  return present;
}

void FluidSimulation::interact(const core::Interaction& interaction) {
  check(interaction);
  const double reach = interaction.radius > 0 ? interaction.radius : kUsualReach * discretisation_.spacing;
  const Hand hand = handOf(interaction, container_);
  if (interaction.action == Action::Add) return addBall(interaction.fluid, hand.ray, hand.crossing, reach);

  TouchForce force{.origin = toArray(hand.ray.origin),
                   .direction = toArray(hand.ray.direction),
                   .radius = reach,
                   .acceleration = interaction.strength,
                   .end = time_ + interaction.seconds,
                   .pulls = interaction.action == Action::Pull ? 1U : 0U};
  if (interaction.action == Action::Push) {
    force.aim = toArray(pushDirection(hand, container_));
  } else {
    const auto met = firstParticle(hand.ray, state_.position, discretisation_.spacing, team_);
    if (!met) refuse("", "the ray meets no fluid that it could pull");
    Vector3d target = hand.ray.at(*met);
    if (container_.plane) target.z() = *container_.plane;
    force.aim = toArray(target);
  }
  touch_.add(force);
}

/// Where the middle of a ball is, in front of what the ray first meets.
Vector3d FluidSimulation::ballCentre(const TouchRay& ray, double radius) const {
  const auto stretch = insideContainer(ray, container_);
  if (!stretch) refuse("", "the ray does not pass through the container");
  // Particles keep one spacing from walls.
  double end = stretch->last - discretisation_.spacing;
  if (const auto met = firstParticle(ray, state_.position, discretisation_.spacing, team_)) end = std::min(end, *met);
  const std::vector<const solids::PlacedBody*> bodies = presentBodies();
  if (const auto met = firstBody(ray, *stretch, bodies, discretisation_.spacing)) {
    end = std::min(end, *met - discretisation_.spacing);
  }
  return ray.at(end - radius);
}

void FluidSimulation::addBall(std::uint32_t fluid, const TouchRay& ray, const std::optional<Vector3d>& crossing,
                              double radius) {
  const auto fluids = static_cast<std::uint32_t>(settings_.fluids_size());
  if (fluid >= fluids) {
    refuse("fluid", std::to_string(fluid) + " is none of the scene's, which are numbered from 0 to " +
                        std::to_string(fluids - 1));
  }
  if (radius > kLargestBall * discretisation_.spacing) {
    refuse("radius", std::to_string(radius) + " m is more than is added at once, " +
                         std::to_string(kLargestBall * discretisation_.spacing) + " m");
  }
  const AddedBall ball{crossing ? *crossing : ballCentre(ray, radius), radius, discretisation_.spacing};
  const std::vector<const solids::PlacedBody*> bodies = presentBodies();
  const BallPlaces places = placesOf(ball, {container_, bodies, state_.position}, team_);
  if (places.free.empty()) refuse("", reasonForNoPlace(places));
  const std::uint64_t most = mostParticles();
  const std::uint64_t room = std::min(most - std::min<std::uint64_t>(most, state_.size()), population_.numbersLeft());
  if (places.free.size() > room) {
    refuse("", "the ball has " + std::to_string(places.free.size()) +
                   " particles; simulation.max_particles, or this machine's free memory, leaves room for " +
                   std::to_string(room));
  }
  append(places.free, fluid);
}

void FluidSimulation::append(const std::vector<Float4>& places, std::uint32_t fluid) {
  // From now on particles are of different ages.
  if (!keepsBirths()) state_.born.assign(state_.size(), 0);
  added_ += places.size();
  const std::size_t before = state_.size();
  const std::uint32_t firstId = population_.takeNumbers(places.size());
  state_.append(newParticle(), places.size());
  for (std::size_t k = 0; k < places.size(); ++k) {
    state_.position[before + k] = places[k];
    state_.id[before + k] = firstId + static_cast<std::uint32_t>(k);
    state_.born[before + k] = time_;
    if (!state_.fluid.empty()) state_.fluid[before + k] = static_cast<std::uint8_t>(fluid);
  }
  // What is known of the last step stays, apart from the densities, which are others now.
  const core::StepStatistics last = statistics_;
  freeFlight_.reset();
  findPairs();
  statistics_.densityIterations = last.densityIterations;
  statistics_.divergenceIterations = last.divergenceIterations;
  statistics_.viscosityIterations = last.viscosityIterations;
  statistics_.stages = last.stages;
}

void FluidSimulation::applyTouch(const StepContext& step) {
  touch_.apply(state_, time_, time_ + step.seconds, mixture_.restDensities(), team_);
}

}  // namespace sluice::sim
