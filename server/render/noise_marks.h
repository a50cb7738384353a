#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "sluice/core/particle_snapshot.h"
#include "sluice/v1/scene.pb.h"

namespace sluice::render {

/// How violently each particle has been shaken of late, Eq. (12) of [vdL09: van der Laan, Green & Sainz 2009,
/// Screen Space Fluid Rendering with Curvature Flow]: 1 at the moment in which its acceleration |Δv|/Δt, between one
/// snapshot and the next, is above the threshold; from then on it falls by e^(−Δt/t_c). Judged by acceleration and not,
/// as printed there, by |Δv|, so that the pace of the snapshots does not matter.
///
/// Particles are followed by their ids, whatever their order. All are calm where the source gives no ids or no
/// velocities; after time has gone back; and a particle that is new is.
class NoiseMarks {
 public:
  /// Goes on to the next snapshot; to the same moment again changes nothing but the order.
  void follow(const core::ParticleSnapshot& particles, const v1::Noise& noise);

  /// 0 to 1 for each particle of the last snapshot, in its order; empty where none can be told.
  std::span<const float> violence() const { return violence_; }

  static bool canFollow(const core::ParticleSnapshot& particles) {
    return !particles.ids.empty() && !particles.velocities.empty();
  }

 private:
  double time_ = 0;
  std::vector<std::uint32_t> ids_;
  std::vector<Eigen::Vector3f> velocities_;
  std::vector<float> violence_;
};

/// Finds the place of an id in an array of ids.
class IdIndex {
 public:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  explicit IdIndex(std::span<const std::uint32_t> ids);
  /// kNone where it is not among them. Of equal ids, the first.
  std::size_t find(std::uint32_t id) const;

 private:
  std::size_t slotOf(std::uint32_t id) const;

  std::span<const std::uint32_t> ids_;
  std::vector<std::uint32_t> slots_;  ///< A place in `ids_`, or kEmpty; a power of two of them, at most half full.
};

}  // namespace sluice::render
