// How far a flow is from what it should be: divergence, energies, momentum.
#include <algorithm>
#include <cmath>
#include <vector>

#include "fluid_simulation.h"

namespace sluice::sim {

namespace {

using Eigen::Vector3d;

struct FlowSums {
  Vector3d momentum = Vector3d::Zero();
  double mass = 0;
  double speeds = 0;  ///< Σ m |v|.
  double kinetic = 0;
  Vector3d moment = Vector3d::Zero();  ///< Σ m x, about the container's corner.

  FlowSums& operator+=(const FlowSums& other) {
    momentum += other.momentum;
    mass += other.mass;
    speeds += other.speeds;
    kinetic += other.kinetic;
    moment += other.moment;
    return *this;
  }
};

FlowSums sumsOf(const ParticleState& state, const Mixture& mixture, double volume, const Team& team) {
  return team.sumOverChunks<FlowSums>(state.size(), [&](const Chunk& chunk) {
    FlowSums part;
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      const double mass = volume * mixture.restDensityOf(state.fluid, i);
      const Vector3d v(state.velocity[i].x, state.velocity[i].y, state.velocity[i].z);
      const double speed2 = v.squaredNorm();
      part.mass += mass;
      part.momentum += mass * v;
      part.speeds += mass * std::sqrt(speed2);
      part.kinetic += 0.5 * mass * speed2;
      part.moment += mass * Vector3d(state.position[i].x, state.position[i].y, state.position[i].z);
    }
    return part;
  });
}

struct RateSum {
  double sum = 0;
  double largest = 0;

  RateSum& operator+=(const RateSum& other) {
    sum += other.sum;
    largest = std::max(largest, other.largest);
    return *this;
  }
};

}  // namespace

core::FlowMeasures FluidSimulation::measures() const {
  core::FlowMeasures measures;
  if (state_.size() == 0) return measures;
  std::vector<float> rate(state_.size());
  const auto rates = team_.sumOverChunks<RateSum>(state_.size(), [&](const Chunk& chunk) {
    lists_.loops().densityRate(lists_.chunk(chunk), state_.velocity.data(), lists_.gradientSum().data(), rate.data());
    RateSum part;
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      const double ofDensity = std::abs(rate[i]) / std::max(lists_.density()[i], 1e-3F);
      part.sum += ofDensity;
      part.largest = std::max(part.largest, ofDensity);
    }
    return part;
  });
  measures.meanDivergence = rates.sum / static_cast<double>(state_.size());
  measures.maxDivergence = rates.largest;

  const FlowSums sums = sumsOf(state_, mixture_, discretisation_.volume, team_);
  const v1::Vec3& g = settings_.gravity();
  const Vector3d origin(container_.origin[0], container_.origin[1], container_.origin[2]);
  measures.kineticEnergy = sums.kinetic;
  measures.potentialEnergy = -Vector3d(g.x(), g.y(), g.z()).dot(sums.moment + sums.mass * origin);
  if (sums.speeds > 0) measures.momentumDrift = momentumDrift_.norm() / sums.speeds;
  return measures;
}

void FluidSimulation::followMomentum(const StepPlan& plan, double seconds) {
  const bool alone = !boundaryInReach_ && !bodiesInReach_ && !population_.changes() && !hasForceField() &&
                     !plan.contains(Stage::Touch);
  if (!alone) {
    momentum_.reset();
    return;
  }
  const FlowSums sums = sumsOf(state_, mixture_, discretisation_.volume, team_);
  const v1::Vec3& g = settings_.gravity();
  if (momentum_) momentumDrift_ += sums.momentum - *momentum_ - sums.mass * seconds * Vector3d(g.x(), g.y(), g.z());
  momentum_ = sums.momentum;
}

}  // namespace sluice::sim
