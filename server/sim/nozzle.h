#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "container.h"
#include "sluice/v1/scene.pb.h"

namespace sluice::sim {

/// A round nozzle (in a planar scene, a slit) and the layers of particles that leave it, one spacing apart: a hexagonal
/// packing of one particle to each spacing squared, cut to a disc. So that the flow is exactly mouth area times speed,
/// whatever the packing, layers differ by a particle: after k of them as many particles have left as the cylinder of k
/// spacings holds, to half a particle. Immutable; all functions are thread-safe.
class Nozzle {
 public:
  /// `path` is the emitter's ("simulation.fluids[0].emitters[1]"). Throws core::InputError where the mouth is smaller
  /// than a particle, ends before it begins, or, in a planar scene, does not lie in its plane or points out of it.
  Nozzle(const v1::Emitter& settings, int fluid, const std::string& path, const Container& container, double spacing);

  const std::string& path() const { return path_; }
  int fluid() const { return fluid_; }
  const Eigen::Vector3d& mouth() const { return mouth_; }          ///< In the container's coordinates, m.
  const Eigen::Vector3d& direction() const { return direction_; }  ///< Of unit length.
  double radius() const { return radius_; }                        ///< m.
  double speed() const { return speed_; }                          ///< m/s.
  double start() const { return start_; }                          ///< s.
  double end() const { return end_; }                              ///< s.
  std::uint64_t most() const { return most_; }                     ///< Particles that it gives.
  double interval() const { return spacing_ / speed_; }            ///< From one layer to the next, s.

  /// Particles of the k-th layer.
  std::uint32_t layerSize(std::uint64_t layer) const;

  /// The most that any layer has.
  std::uint32_t largestLayer() const { return static_cast<std::uint32_t>(offsets_.size()); }

  /// Where the n-th particle of a layer, from the middle outwards, is `seconds` after it passed the mouth, if nothing
  /// but gravity acts on it.
  Eigen::Vector3d placeOf(std::uint32_t particle, double seconds, const Eigen::Vector3d& gravity) const {
    return mouth_ + offsets_[particle] + seconds * (speed_ * direction_ + 0.5 * seconds * gravity);
  }
  Eigen::Vector3d velocityAfter(double seconds, const Eigen::Vector3d& gravity) const {
    return speed_ * direction_ + seconds * gravity;
  }

 private:
  void packDisc();
  void packSlit();

  std::string path_;
  int fluid_;
  Eigen::Vector3d mouth_;
  Eigen::Vector3d direction_;
  double radius_;
  double speed_;
  double start_;
  double end_;
  std::uint64_t most_;
  double spacing_;
  double perLayer_;                       ///< Particles, on average.
  std::vector<Eigen::Vector3d> offsets_;  ///< From the middle, m, from the inside outwards.
};

}  // namespace sluice::sim
