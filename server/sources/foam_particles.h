#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "foam_grid.h"
#include "foam_potentials.h"
#include "foam_walls.h"
#include "sluice/core/particle_snapshot.h"
#include "sluice/core/state_stream.h"

namespace sluice::sources {

/// How secondary particles live.
struct FoamLife {
  Eigen::Vector3f gravity{0, -9.81F, 0};  ///< m/s².
  float lifetime = 3;                     ///< Of foam, s.
  float buoyancy = 2;                     ///< k_b.
  float drag = 0.8F;                      ///< k_d.
  std::size_t most = 100'000;
};

/// What a secondary particle with so many neighbours of the liquid is [Ihmsen et al. 2012, section 4.1].
core::DiffuseKind kindOf(float neighbours);

/// Spray, foam and bubbles, which the liquid carries and which do nothing to it [Ihmsen et al. 2012]. Everything is
/// drawn from a hash of the seed, the liquid particle's id and the step, and nothing depends on the number of threads.
class FoamParticles {
 public:
  explicit FoamParticles(std::uint64_t seed = 1) : seed_(seed) {}

  const core::DiffuseParticles& all() const { return all_; }
  void add(const Eigen::Vector3f& position, const Eigen::Vector3f& velocity, core::DiffuseKind kind, float remaining);
  void clear() { *this = FoamParticles(seed_); }

  void save(core::StateWriter& out) const;
  /// Throws core::InputError where the arrays do not fit together.
  void resume(core::StateReader& in);

  /// Moves on by `seconds` to the time of `liquid`, ages, and removes what is gone: foam that is too old, spray that
  /// lands on the ground or falls out of the scene.
  void advance(const LiquidGrid& liquid, const FoamWalls& walls, const FoamScales& scales, const FoamLife& life,
               float seconds, int threads);

  /// Makes new ones, as many as the potentials say for `seconds`. `ids` are the liquid's in the order of the snapshot,
  /// or empty.
  void create(const LiquidGrid& liquid, const FoamPotentials& potentials, std::span<const std::uint32_t> ids,
              const FoamWalls& walls, const FoamScales& scales, float seconds);

  /// Removes what is beyond `most`: the oldest foam first, then whatever else is oldest.
  void keepAtMost(std::size_t most);

 private:
  template <class Keep>
  void removeUnless(const Keep& keep);

  std::uint64_t seed_;
  core::DiffuseParticles all_;
  std::uint32_t nextId_ = 0;
  std::uint64_t step_ = 0;

  std::vector<std::uint32_t> cell_;
  std::vector<std::uint32_t> order_;  ///< By cell.
};

}  // namespace sluice::sources
