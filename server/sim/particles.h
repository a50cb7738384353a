#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "team.h"

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
/// every step (particles are sorted by cell); `id` tells who is who. Arrays that a scene has no use for are empty.
/// Positions are relative to the container's lower corner, so that floats keep their resolution wherever the container
/// stands.
struct ParticleState {
  std::vector<Float4> position;       ///< m.
  std::vector<Float4> velocity;       ///< m/s.
  std::vector<float> densityImpulse;  ///< κ, pressure times dt over the heaviest rest density, m²/s, of the last step.
  std::vector<std::uint32_t> id;

  std::vector<std::uint8_t> fluid;       ///< Index of its fluid, where there are several.
  std::vector<float> divergenceImpulse;  ///< κ of DFSPH's last divergence solve, m²/s.
  std::vector<float> compression;        ///< ρ/ρ0 - 1 that weakly compressible SPH integrates.
  std::vector<Float4> spin;              ///< Microrotation ω, rad/s.
  std::vector<double> born;              ///< When it came into the scene, s, where there are emitters.

  std::size_t size() const { return position.size(); }

  /// Calls `action` with each array of this and the same one of `other`.
  template <class Other, class Action>
  void forEachArray(Other& other, Action&& action) {
    forEachArrayOf(*this, other, action);
  }
  template <class Other, class Action>
  void forEachArray(Other& other, Action&& action) const {
    forEachArrayOf(*this, other, action);
  }

  /// Sizes every array as it is in `other`.
  void resizeLike(const ParticleState& other) {
    forEachArray(other, [](auto& to, const auto& from) { to.resize(from.size()); });
  }

  /// Takes the particles `order`[chunk.first], … of `from` to the places of a chunk, in arrays sized alike.
  void gather(const ParticleState& from, const std::vector<std::uint32_t>& order, const Chunk& chunk) {
    forEachArray(from, [&](auto& to, const auto& values) {
      if (values.empty()) return;
      for (std::size_t i = chunk.first; i < chunk.last; ++i) to[i] = values[order[i]];
    });
  }

  /// Adds copies of a particle, `particle`, in those arrays that it has.
  void append(const ParticleState& particle, std::size_t copies) {
    forEachArray(particle, [&](auto& to, const auto& one) {
      if (!one.empty()) to.resize(to.size() + copies, one.front());
    });
  }

  /// Leaves the particles of the given indices, in ascending order, and no others.
  void keep(const std::vector<std::uint32_t>& indices) {
    forEachArray(*this, [&](auto& values, const auto&) {
      if (values.empty()) return;
      for (std::size_t k = 0; k < indices.size(); ++k) values[k] = values[indices[k]];
      values.resize(indices.size());
    });
  }

  bool operator==(const ParticleState&) const = default;

 private:
  template <class State, class Other, class Action>
  static void forEachArrayOf(State& state, Other& other, Action&& action) {
    action(state.position, other.position);
    action(state.velocity, other.velocity);
    action(state.densityImpulse, other.densityImpulse);
    action(state.id, other.id);
    action(state.fluid, other.fluid);
    action(state.divergenceImpulse, other.divergenceImpulse);
    action(state.compression, other.compression);
    action(state.spin, other.spin);
    action(state.born, other.born);
  }
};

}  // namespace sluice::sim
