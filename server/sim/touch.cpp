#include "touch.h"

#include <algorithm>
#include <cmath>
#include <ranges>

#include "sluice/core/input_error.h"

namespace sluice::sim {

namespace {

using Eigen::Vector3d;

/// A viewer sends some ten touches a second of a tenth of a second each; more at a time come from a flood of messages,
/// or from a hand that goes on while the simulation stands.
constexpr std::size_t kMostForces = 64;

Vector3d toVector(const std::array<double, 3>& v) { return Vector3d::Map(v.data()); }

/// Of momentum per volume, kg/(m² s).
struct Change {
  Vector3d sum = Vector3d::Zero();
  Change& operator+=(const Change& other) {
    sum += other.sum;
    return *this;
  }
};

/// A force over the part of a step in which it acts.
struct Share {
  Vector3d origin;
  Vector3d direction;
  Vector3d aim;
  double inverseSquare;  ///< 1/R², 1/m².
  double speed;          ///< Change of velocity at the ray, m/s.
  bool pulls;
};

std::vector<Share> sharesOf(const std::vector<TouchForce>& forces, double time, double end) {
  std::vector<Share> shares;
  for (const TouchForce& force : forces) {
    const double seconds = std::min(force.end, end) - time;
    if (!(seconds > 0)) continue;
    shares.push_back({toVector(force.origin), toVector(force.direction), toVector(force.aim),
                      1 / (force.radius * force.radius), force.acceleration * seconds, force.pulls != 0});
  }
  return shares;
}

/// Change of the velocity of a particle at `x`, m/s.
Vector3d changeAt(const Vector3d& x, const Share& share, double softening) {
  const Vector3d relative = x - share.origin;
  const double along = std::max(relative.dot(share.direction), 0.0);
  const double square = (relative - along * share.direction).squaredNorm() * share.inverseSquare;
  if (square >= 1) return Vector3d::Zero();
  const double speed = share.speed * (1 - square) * (1 - square);
  if (!share.pulls) return speed * share.aim;
  const Vector3d way = share.aim - x;
  return speed / std::max(way.norm(), softening) * way;
}

}  // namespace

void Touch::add(const TouchForce& force) {
  if (forces_.size() >= kMostForces) {
    throw core::InputError("", "interact",
                           std::to_string(kMostForces) + " touches act on the fluid already; wait until one has ended");
  }
  forces_.push_back(force);
}

bool Touch::isActive(double time) const {
  return std::ranges::any_of(forces_, [&](const TouchForce& force) { return force.end > time; });
}

double Touch::largestAcceleration(double time) const {
  double sum = 0;
  for (const TouchForce& force : forces_) sum += force.end > time ? force.acceleration : 0;
  return sum;
}

Vector3d Touch::apply(ParticleState& particles, double time, double end, const std::vector<double>& restDensities,
                      const Team& team) const {
  const std::vector<Share> shares = sharesOf(forces_, time, end);
  const auto changed = team.sumOverChunks<Change>(particles.size(), [&](const Chunk& chunk) {
    Change part;
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      const Float4& at = particles.position[i];
      Vector3d change = Vector3d::Zero();
      for (const Share& share : shares) change += changeAt({at.x, at.y, at.z}, share, softening_);
      if (change.isZero(0)) continue;
      Float4& v = particles.velocity[i];
      const Eigen::Vector3f dv = change.cast<float>();
      v = {v.x + dv.x(), v.y + dv.y(), v.z + dv.z(), 0};
      part.sum += restDensities[particles.fluid.empty() ? 0 : particles.fluid[i]] * dv.cast<double>();
    }
    return part;
  });
  return changed.sum;
}

void Touch::expire(double time) {
  std::erase_if(forces_, [&](const TouchForce& force) { return !(force.end > time); });
}

void Touch::save(core::StateWriter& out) const { out.write(forces_); }

void Touch::resume(core::StateReader& in) {
  std::vector<TouchForce> saved;
  in.read(saved);
  const auto fits = [](const TouchForce& force) {
    return toVector(force.origin).allFinite() && toVector(force.direction).allFinite() &&
           toVector(force.aim).allFinite() && force.radius > 0 && std::isfinite(force.radius) &&
           force.acceleration >= 0 && std::isfinite(force.acceleration) && std::isfinite(force.end) && force.pulls <= 1;
  };
  if (saved.size() > kMostForces || !std::ranges::all_of(saved, fits)) in.fail("its touches of the fluid are none");
  forces_ = std::move(saved);
}

}  // namespace sluice::sim
