#pragma once

#include <cstdint>
#include <vector>

#include "mixture.h"
#include "moving_boundary.h"
#include "neighbour_lists.h"

namespace sluice::sim {

/// What one particle feels of one body: with r_b from the body's centre of mass to a boundary particle b,
///
///   J = (Σ_b V_b ∇W_ib, Σ_b r_b × V_b ∇W_ib),
///
/// so that the body's twist ν changes the particle's density at the rate -J·ν, and an impulse κ_i of the particle's
/// pressure changes the body's momentum by ρ_max V κ_i J: force and counterforce are the same sums [Akinci et al. 2012,
/// Versatile rigid-fluid coupling for incompressible SPH].
struct BodyContact {
  std::uint32_t particle = 0;
  std::uint32_t body = 0;
  Eigen::Matrix<float, 6, 1> jacobian = Eigen::Matrix<float, 6, 1>::Zero();  ///< 1/m, and 1.
};

/// Friction of one particle at one body, for a strength of 1 m²: with K_b = -V_b W'(|x|)/|x| x xᵀ/(|x|² + 0.01 H²) and
/// P_b = (1, -[r_b]×), which makes the velocity at b of a twist.
struct FrictionContact {
  std::uint32_t particle = 0;
  std::uint32_t body = 0;
  Eigen::Matrix3f own = Eigen::Matrix3f::Zero();                               ///< Σ K_b.
  Eigen::Matrix<float, 3, 6> toParticle = Eigen::Matrix<float, 3, 6>::Zero();  ///< Σ K_b P_b.
  Eigen::Matrix<float, 6, 6> ofBody = Eigen::Matrix<float, 6, 6>::Zero();      ///< Σ P_bᵀ K_b P_b.
};

/// Which particles touch which moving bodies, found once per step; kept by chunks of particles, as pairs are.
class BodyContacts {
 public:
  /// Finds them, and adds the bodies' boundary particles to the sums of `lists`.
  void find(const MovingBoundary& boundary, const MovingBodies& bodies, const CellGrid& grid,
            const std::vector<Float4>& positions, NeighbourLists& lists, const Team& team);

  void clear();
  bool empty() const { return count_ == 0; }
  const std::vector<BodyContact>& of(const Chunk& chunk) const { return contacts_[chunk.index]; }

  /// Σ_i κ_i J_i of each body, with κ in the first lane.
  BodySums weigh(const std::vector<Float4>& impulse, std::size_t bodies, const Team& team) const;

  /// Adds `factor` times J·ν of the bodies' twists to each particle's value.
  void addRates(const MovingBodies& bodies, float factor, std::vector<float>& values, const Team& team) const;

  /// Friction over `seconds` between the particles and the bodies that have some: implicit in both, so that it is
  /// stable in any step, and with the same impulse on either side.
  void rub(MovingBodies& bodies, const Mixture& mixture, double particleVolume, double seconds,
           const std::vector<std::uint8_t>& fluid, std::vector<Float4>& velocity, const Team& team) const;

  std::uint64_t bytes() const;

 private:
  std::vector<std::vector<BodyContact>> contacts_;
  std::vector<std::vector<FrictionContact>> frictions_;
  std::size_t particles_ = 0;
  std::size_t count_ = 0;
};

/// The moving bodies' part in a solve for pressure impulses: how they answer to them, and how fast they compress.
class BodyCoupling {
 public:
  /// Particles at a body that are
  /// compressed are not given their whole volume back in a step, but a rest density in `easingSeconds`: where a body
  /// has squeezed them into a gap narrower than they are, they would leave it the faster the shorter the step is.
  BodyCoupling(MovingBodies& bodies, const BodyContacts& contacts, const Mixture& mixture, double particleVolume,
               double easingSeconds)
      : bodies_(&bodies),
        contacts_(&contacts),
        mixture_(&mixture),
        particleVolume_(particleVolume),
        easingSeconds_(easingSeconds) {}

  bool isIdle() const { return contacts_->empty(); }

  /// Takes the bodies' present twists as those without pressure. `density` is null in a divergence solve.
  void begin(const std::vector<float>& factor, const std::vector<float>* density, double seconds, const Team& team);

  /// Pressure factors with what the bodies add to the diagonal.
  const std::vector<float>& factor() const { return factor_; }
  /// Densities, or ones, less what the bodies' motion takes from them within the step.
  const std::vector<float>& density() const { return density_; }

  /// Twists and densities that go with these impulses.
  void respond(const std::vector<Float4>& impulse, const Team& team);

  /// Changes twists by the answer to impulses, times a factor, once.
  void push(const std::vector<Float4>& impulse, double factor, const Team& team);

  void addRates(float factor, std::vector<float>& values, const Team& team) const {
    contacts_->addRates(*bodies_, factor, values, team);
  }

 private:
  /// What an impulse of 1 m²/s with a gradient of 1/m carries: ρ_max V, kg.
  double momentum() const { return mixture_->heaviest() * particleVolume_; }
  void easeCompression(const Team& team);

  MovingBodies* bodies_;
  const BodyContacts* contacts_;
  const Mixture* mixture_;
  double particleVolume_;
  double easingSeconds_;
  double seconds_ = 0;
  std::vector<Vector6d> start_;
  std::vector<Eigen::Matrix<double, 6, 6>> inverse_;
  std::vector<float> factor_;
  std::vector<float> restingDensity_;
  std::vector<float> density_;
};

}  // namespace sluice::sim
