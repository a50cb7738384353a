#include "adhesion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace sluice::sim {

namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

/// (-4q² + 6q - 2)^¼ where it is real, 0 elsewhere: A over its factor, at distance qH. 1/√2 at most, at q = ¾.
template <class Real>
Real attraction(Real q) {
  const Real square = (4 * q - 2) * (1 - q);
  return square > 0 ? std::sqrt(std::sqrt(square)) : Real{0};
}

/// ∫ attraction from q to 1: the energy of a pair, over H.
double pairEnergy(double q) {
  constexpr int kIntervals = 200;
  const double from = std::clamp(q, 0.5, 1.0);
  const double width = (1 - from) / kIntervals;
  double sum = 0;
  for (int k = 0; k < kIntervals; ++k) sum += attraction(from + (k + 0.5) * width) * width;
  return sum;
}

/// Mean over a particle's places of the energy that it has at height `z` above a plane lattice of boundary particles,
/// each of a fluid particle's volume, over H.
double energyAbovePlane(const Discretisation& d, double z) {
  if (z >= d.support) return 0;
  constexpr int kIntervals = 100;
  const double reach = std::sqrt(d.support * d.support - z * z);
  const double width = reach / kIntervals;
  double sum = 0;
  for (int k = 0; k < kIntervals; ++k) {
    const double x = (k + 0.5) * width;
    const double measure = d.dimensions == 2 ? 2 / d.spacing : 2 * std::numbers::pi * x / (d.spacing * d.spacing);
    sum += measure * pairEnergy(std::sqrt(x * x + z * z) / d.support) * width;
  }
  return sum;
}

/// The energy of a column of fluid, one particle wide, that stands on a flat wall, for a force of 1 between particles
/// of equal volume, m.
double energyOfColumn(const Discretisation& d) {
  const int layers = boundaryLayers(d);
  const std::vector<double> volumes = wallVolumes(d, layers);
  double sum = 0;
  for (int layer = 0; layer < layers; ++layer) {
    for (int above = 1; (above + layer) * d.spacing < d.support; ++above) {
      sum += volumes[static_cast<std::size_t>(layer)] * energyAbovePlane(d, (above + layer) * d.spacing);
    }
  }
  return sum * d.support;
}

/// The sum of A V_b/V x_ib/|x_ib| over the points of a grid around one place, with a weight for each; `note` sees every
/// term.
template <class Weight, class Note>
Vector3f pull(const CellGrid& grid, std::uint32_t cell, const std::vector<Float4>& points, const Float4& place,
              float support, const Weight& weight, const Note& note) {
  const CellGrid::Neighbourhood around = grid.around(cell);
  const Vector3f xi(place.x, place.y, place.z);
  Vector3f sum = Vector3f::Zero();
  for (std::size_t r = 0; r < static_cast<std::size_t>(around.count); ++r) {
    for (std::uint32_t b = around.ranges[r].first; b < around.ranges[r].last; ++b) {
      const Vector3f x = xi - Vector3f(points[b].x, points[b].y, points[b].z);
      const float distance = x.norm();
      if (distance >= support || distance <= 0.5F * support) continue;
      const Vector3f term = (weight(b) * attraction(distance / support) / distance) * x;
      sum += term;
      note(b, term);
    }
  }
  return sum;
}

void change(Float4& velocity, const Vector3f& by) {
  velocity = {velocity.x + by.x(), velocity.y + by.y(), velocity.z + by.z(), 0};
}

}  // namespace

Adhesion::Adhesion(const Discretisation& d)
    // 2a d^(D-1) = V S Σ_k U_k with the force S between particles of equal volume: work per area over a column's base.
    : forcePerAdhesion_(2 * std::pow(d.spacing, d.dimensions - 1) / (d.volume * energyOfColumn(d))) {}

void Adhesion::apply(double ofContainer, const Bodies& bodies, StepContext& step) const {
  if (ofContainer > 0 || bodies.anyStandingAdheres()) attractToStanding(ofContainer, bodies, step);
  // Where no particle has been found to touch one, their samples may be where they were some steps ago.
  if (step.bodies != nullptr && !step.bodies->contacts.empty()) attractToMoving(step);
}

void Adhesion::attractToStanding(double ofContainer, const Bodies& bodies, StepContext& step) const {
  std::vector<float> strength{static_cast<float>(ofContainer * forcePerAdhesion_ * step.seconds)};
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    strength.push_back(static_cast<float>(bodies.adhesion(k) * forcePerAdhesion_ * step.seconds));
  }
  const Boundary& boundary = step.boundary;
  const auto weight = [&](std::uint32_t b) { return strength[boundary.surfaces()[b]] * boundary.volumes()[b]; };
  const auto support = static_cast<float>(step.discretisation.support);
  ParticleState& state = step.state;
  step.team.forEachChunk(state.size(), [&](const Chunk& chunk) {
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      const Vector3f sum = pull(boundary.grid(), step.grid.cellOfSorted()[i], boundary.points(), state.position[i],
                                support, weight, [](std::uint32_t, const Vector3f&) {});
      change(state.velocity[i], -sum / static_cast<float>(step.mixture.restDensityOf(state.fluid, i)));
    }
  });
}

void Adhesion::attractToMoving(StepContext& step) const {
  MovingBodies& bodies = step.bodies->bodies;
  const MovingBoundary& boundary = step.bodies->boundary;
  std::vector<float> strength;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    strength.push_back(static_cast<float>(bodies.adhesion(k) * forcePerAdhesion_ * step.seconds));
  }
  const auto weight = [&](std::uint32_t b) { return strength[boundary.bodyOf()[b]] * boundary.volumes()[b]; };
  const auto support = static_cast<float>(step.discretisation.support);
  ParticleState& state = step.state;
  const BodySums taken = step.team.sumOverChunks<BodySums>(state.size(), [&](const Chunk& chunk) {
    BodySums part;
    const auto hand = [&](std::uint32_t b, const Vector3f& term) {
      const std::uint8_t body = boundary.bodyOf()[b];
      if (!bodies.floats(body)) return;
      if (part.ofBody.empty()) part.ofBody.resize(bodies.size(), Vector6d::Zero());
      const Float4& p = boundary.points()[b];
      const Vector3d impulse = step.discretisation.volume * term.cast<double>();
      part.ofBody[body].head<3>() += impulse;
      part.ofBody[body].tail<3>() += (Vector3d(p.x, p.y, p.z) - bodies.centre(body)).cross(impulse);
    };
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      const Vector3f sum = pull(boundary.grid(), step.grid.cellOfSorted()[i], boundary.points(), state.position[i],
                                support, weight, hand);
      change(state.velocity[i], -sum / static_cast<float>(step.mixture.restDensityOf(state.fluid, i)));
    }
    return part;
  });
  bodies.push(taken);
}

}  // namespace sluice::sim
