#include "body_contacts.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "kernel.h"

namespace sluice::sim {

namespace {

using Eigen::Matrix3d;
using Eigen::Matrix3f;
using Eigen::Vector3d;
using Eigen::Vector3f;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

template <class T>
Eigen::Matrix<T, 3, 3> crossMatrix(const Eigen::Matrix<T, 3, 1>& r) {
  Eigen::Matrix<T, 3, 3> matrix;
  matrix << 0, -r.z(), r.y(), r.z(), 0, -r.x(), -r.y(), r.x(), 0;
  return matrix;
}

/// What one particle gathers over the samples around it.
struct Gathered {
  float density = 0;
  Vector3f gradient = Vector3f::Zero();
  std::uint16_t neighbours = 0;
};

/// The element of a particle's run at the end of a list that is of `body`.
template <class Contact>
Contact& contactWith(std::vector<Contact>& contacts, std::size_t first, std::uint32_t particle, std::uint32_t body) {
  for (std::size_t k = first; k < contacts.size(); ++k) {
    if (contacts[k].body == body) return contacts[k];
  }
  Contact& added = contacts.emplace_back();
  added.particle = particle;
  added.body = body;
  return added;
}

void addFriction(FrictionContact& contact, const Vector3f& x, const Vector3f& fromCentre, float strength) {
  const Matrix3f pair = strength * x * x.transpose();
  Eigen::Matrix<float, 3, 6> velocityAt;
  velocityAt << Matrix3f::Identity(), -crossMatrix(fromCentre);
  const Eigen::Matrix<float, 3, 6> felt = pair * velocityAt;
  contact.own += pair;
  contact.toParticle += felt;
  contact.ofBody += velocityAt.transpose() * felt;
}

/// Two particles nearer than this share of the support have no direction between them.
constexpr float kTiny = 1e-6F;

}  // namespace

void BodyContacts::clear() {
  for (auto& contacts : contacts_) contacts.clear();
  for (auto& frictions : frictions_) frictions.clear();
  count_ = 0;
}

void BodyContacts::find(const MovingBoundary& boundary, const MovingBodies& bodies, const CellGrid& grid,
                        const std::vector<Float4>& positions, NeighbourLists& lists, const Team& team) {
  particles_ = positions.size();
  contacts_.resize(chunkCount(particles_));
  frictions_.resize(chunkCount(particles_));
  clear();
  const PairScale& scale = lists.scale();
  const float support = scale.support;
  const auto gather = [&]<class Kernel>(Kernel, const Chunk& chunk) {
    std::vector<BodyContact>& contacts = contacts_[chunk.index];
    std::vector<FrictionContact>& frictions = frictions_[chunk.index];
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      const CellGrid::Neighbourhood around = boundary.grid().around(grid.cellOfSorted()[i]);
      if (around.points == 0) continue;
      const std::size_t first = contacts.size();
      const std::size_t firstFriction = frictions.size();
      const auto particle = static_cast<std::uint32_t>(i);
      const Vector3f xi(positions[i].x, positions[i].y, positions[i].z);
      Gathered sums;
      for (std::size_t r = 0; r < static_cast<std::size_t>(around.count); ++r) {
        for (std::uint32_t b = around.ranges[r].first; b < around.ranges[r].last; ++b) {
          const Float4& p = boundary.points()[b];
          const Vector3f xb(p.x, p.y, p.z);
          const Vector3f x = xi - xb;
          const float distance = x.norm();
          if (distance >= support) continue;
          const float volume = boundary.volumes()[b];
          const float q = distance / support;
          sums.density += scale.value * volume * Kernel::value(q);
          ++sums.neighbours;
          if (distance <= kTiny * support) continue;
          const float perMetre = scale.slope * volume * Kernel::slope(q) / distance;
          const Vector3f gradient = perMetre * x;
          sums.gradient += gradient;
          const std::uint32_t body = boundary.bodyOf()[b];
          const Vector3f fromCentre = (xb.cast<double>() - bodies.centre(body)).cast<float>();
          BodyContact& contact = contactWith(contacts, first, particle, body);
          contact.jacobian.head<3>() += gradient;
          contact.jacobian.tail<3>() += fromCentre.cross(gradient);
          if (bodies.friction(body) == 0) continue;
          addFriction(contactWith(frictions, firstFriction, particle, body), x, fromCentre,
                      -perMetre / (distance * distance + 0.01F * support * support));
        }
      }
      lists.addToSums(i, sums.density, {sums.gradient.x(), sums.gradient.y(), sums.gradient.z(), 0}, sums.neighbours);
    }
  };
  team.forEachChunk(particles_, [&](const Chunk& chunk) {
    if (scale.kernel == KernelKind::WendlandC2) {
      gather(WendlandC2{}, chunk);
    } else {
      gather(CubicSpline{}, chunk);
    }
  });
  for (const auto& contacts : contacts_) count_ += contacts.size();
}

BodySums BodyContacts::weigh(const std::vector<Float4>& impulse, std::size_t bodies, const Team& team) const {
  BodySums sums = team.sumOverChunks<BodySums>(particles_, [&](const Chunk& chunk) {
    BodySums part;
    if (of(chunk).empty()) return part;
    part.ofBody.resize(bodies, Vector6d::Zero());
    for (const BodyContact& contact : of(chunk)) {
      part.ofBody[contact.body] += static_cast<double>(impulse[contact.particle].x) * contact.jacobian.cast<double>();
    }
    return part;
  });
  sums.ofBody.resize(bodies, Vector6d::Zero());
  return sums;
}

void BodyContacts::addRates(const MovingBodies& bodies, float factor, std::vector<float>& values,
                            const Team& team) const {
  team.forEachChunk(particles_, [&](const Chunk& chunk) {
    for (const BodyContact& contact : of(chunk)) {
      const double rate = contact.jacobian.cast<double>().dot(bodies.twist(contact.body));
      values[contact.particle] += factor * static_cast<float>(rate);
    }
  });
}

/// With S = ν_k·2(D+2)·dt, velocities after friction obey
///   v_i = v_i* - S (Σ_b K_b v_i - Σ_b K_b P_b ν),   M (ν - ν*) = S Σ_i m_i (Σ_b P_bᵀ K_b v_i - Σ_b P_bᵀ K_b P_b ν).
/// The particles' are eliminated, which leaves six equations for a body that floats. One body after another.
void BodyContacts::rub(MovingBodies& bodies, const Mixture& mixture, double particleVolume, double seconds,
                       const std::vector<std::uint8_t>& fluid, std::vector<Float4>& velocity, const Team& team) const {
  constexpr double kViscousFactor = 10;  // 2(D + 2).
  const auto massOf = [&](std::uint32_t i) { return particleVolume * mixture.restDensityOf(fluid, i); };
  const auto velocityOf = [&](std::uint32_t i) { return Vector3d(velocity[i].x, velocity[i].y, velocity[i].z); };
  for (std::uint32_t k = 0; k < bodies.size(); ++k) {
    const double strength = kViscousFactor * bodies.friction(k) * seconds;
    if (strength == 0 || !bodies.isSolid(k)) continue;
    const auto forEach = [&](const Chunk& chunk, const auto& action) {
      for (const FrictionContact& contact : frictions_[chunk.index]) {
        if (contact.body != k) continue;
        const Matrix3d inverse = (Matrix3d::Identity() + strength * contact.own.cast<double>()).inverse();
        action(contact.particle, inverse, Eigen::Matrix<double, 3, 6>(strength * contact.toParticle.cast<double>()),
               contact);
      }
    };
    if (bodies.floats(k)) {
      struct System {
        Matrix6d matrix = Matrix6d::Zero();
        Vector6d right = Vector6d::Zero();
        System& operator+=(const System& other) {
          matrix += other.matrix;
          right += other.right;
          return *this;
        }
      };
      const auto system = team.sumOverChunks<System>(particles_, [&](const Chunk& chunk) {
        System part;
        forEach(chunk, [&](std::uint32_t i, const Matrix3d& inverse, const Eigen::Matrix<double, 3, 6>& felt,
                           const FrictionContact& contact) {
          const double mass = massOf(i);
          part.matrix += mass * (strength * contact.ofBody.cast<double>() - felt.transpose() * inverse * felt);
          part.right += mass * felt.transpose() * (inverse * velocityOf(i));
        });
        return part;
      });
      const Matrix6d mass = bodies.massMatrix(k);
      bodies.setTwist(k, (mass + system.matrix).ldlt().solve(mass * bodies.twist(k) + system.right));
    }
    team.forEachChunk(particles_, [&](const Chunk& chunk) {
      forEach(chunk, [&](std::uint32_t i, const Matrix3d& inverse, const Eigen::Matrix<double, 3, 6>& felt,
                         const FrictionContact&) {
        const Vector3d after = inverse * (velocityOf(i) + felt * bodies.twist(k));
        velocity[i] = {static_cast<float>(after.x()), static_cast<float>(after.y()), static_cast<float>(after.z()), 0};
      });
    });
  }
}

std::uint64_t BodyContacts::bytes() const {
  std::uint64_t total = 0;
  for (const auto& contacts : contacts_) total += contacts.capacity() * sizeof(BodyContact);
  for (const auto& frictions : frictions_) total += frictions.capacity() * sizeof(FrictionContact);
  return total;
}

void BodyCoupling::begin(const std::vector<float>& factor, const std::vector<float>* density, double seconds,
                         const Team& team) {
  seconds_ = seconds;
  factor_ = factor;
  if (density != nullptr) {
    restingDensity_ = *density;
  } else {
    restingDensity_.assign(factor.size(), 1);
  }
  if (density != nullptr) easeCompression(team);
  density_ = restingDensity_;
  start_.clear();
  inverse_.clear();
  for (std::size_t k = 0; k < bodies_->size(); ++k) {
    start_.push_back(bodies_->twist(k));
    inverse_.push_back(bodies_->inverseMass(k));
  }
  // |J| in the norm of the inverse mass. All particles at a body push it together: by the sum of these over them, each
  // row's entries are at most |J_i| Σ_j |J_j| besides the fluid's own, and the iteration converges however light the
  // body is, as with the diagonal of Baker et al. 2011, Multigrid smoothers for ultraparallel computing.
  const auto lengthOf = [&](const BodyContact& contact) {
    const Vector6d j = contact.jacobian.cast<double>();
    return std::sqrt(std::max(0.0, j.dot(inverse_[contact.body] * j)));
  };
  const BodySums lengths = team.sumOverChunks<BodySums>(factor.size(), [&](const Chunk& chunk) {
    BodySums part;
    if (contacts_->of(chunk).empty()) return part;
    part.ofBody.resize(bodies_->size(), Vector6d::Zero());
    for (const BodyContact& contact : contacts_->of(chunk)) {
      if (factor[contact.particle] > 0) part.ofBody[contact.body][0] += lengthOf(contact);
    }
    return part;
  });
  if (lengths.ofBody.empty()) return;
  team.forEachChunk(factor.size(), [&](const Chunk& chunk) {
    for (const BodyContact& contact : contacts_->of(chunk)) {
      float& alpha = factor_[contact.particle];
      if (alpha == 0) continue;
      const double added = momentum() * lengthOf(contact) * lengths.ofBody[contact.body][0];
      alpha = static_cast<float>(1 / (1 / static_cast<double>(alpha) + added));
    }
  });
}

void BodyCoupling::easeCompression(const Team& team) {
  const auto most = static_cast<float>(1 + seconds_ / easingSeconds_);
  team.forEachChunk(restingDensity_.size(), [&](const Chunk& chunk) {
    for (const BodyContact& contact : contacts_->of(chunk)) {
      float& density = restingDensity_[contact.particle];
      density = std::min(density, most);
    }
  });
}

void BodyCoupling::respond(const std::vector<Float4>& impulse, const Team& team) {
  const BodySums pushed = contacts_->weigh(impulse, bodies_->size(), team);
  for (std::size_t k = 0; k < bodies_->size(); ++k) {
    if (bodies_->floats(k)) bodies_->setTwist(k, start_[k] + momentum() * inverse_[k] * pushed.ofBody[k]);
  }
  team.forEachChunk(density_.size(), [&](const Chunk& chunk) {
    for (const BodyContact& contact : contacts_->of(chunk)) {
      density_[contact.particle] = restingDensity_[contact.particle];
    }
  });
  contacts_->addRates(*bodies_, -static_cast<float>(seconds_), density_, team);
}

void BodyCoupling::push(const std::vector<Float4>& impulse, double factor, const Team& team) {
  const BodySums pushed = contacts_->weigh(impulse, bodies_->size(), team);
  for (std::size_t k = 0; k < bodies_->size(); ++k) {
    if (!bodies_->floats(k)) continue;
    bodies_->setTwist(k, bodies_->twist(k) + factor * momentum() * bodies_->inverseMass(k) * pushed.ofBody[k]);
  }
}

}  // namespace sluice::sim
