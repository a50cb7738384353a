#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sluice::sim {

/// Three components in four lanes, the fourth unused: what one vector load takes.
struct alignas(16) Float4 {
  float x = 0;
  float y = 0;
  float z = 0;
  float w = 0;

  bool operator==(const Float4&) const = default;
};

/// What a particle carries from step to step. One element per particle in every array, all in one order, which changes
/// every step (particles are sorted by cell); `id` tells who is who. Positions are relative to the container's lower
/// corner, so that floats keep their resolution wherever the container stands.
struct ParticleState {
  std::vector<Float4> position;          ///< m.
  std::vector<Float4> velocity;          ///< m/s.
  std::vector<float> densityImpulse;     ///< κ of the last density solve, m²/s; the next one starts from it.
  std::vector<float> divergenceImpulse;  ///< κ of the last divergence solve, m²/s.
  std::vector<std::uint32_t> id;
  std::vector<std::uint8_t> fluid;  ///< Index of its fluid; empty where there is but one.

  std::size_t size() const { return position.size(); }

  /// Of all arrays but `fluid`, which is either empty or full from the initial state on.
  void resize(std::size_t count) {
    position.resize(count);
    velocity.resize(count);
    densityImpulse.resize(count);
    divergenceImpulse.resize(count);
    id.resize(count);
  }

  bool operator==(const ParticleState&) const = default;
};

}  // namespace sluice::sim
