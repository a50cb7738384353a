#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "bodies.h"
#include "container.h"
#include "discretisation.h"
#include "moving_bodies.h"
#include "nozzle.h"
#include "particles.h"
#include "sluice/core/state_stream.h"
#include "sluice/v1/scene.pb.h"
#include "team.h"

namespace sluice::sim {

/// What emitters and drains know from step to step. Numbers alone, without padding: saved as they are.
struct PopulationState {
  struct Flow {
    double anchor = 0;              ///< When the layer passed the mouth that times are counted from, s.
    std::uint64_t sinceAnchor = 0;  ///< Layers from there to the next.
    std::uint64_t layers = 0;       ///< That have left.
    std::uint64_t given = 0;        ///< Particles that have left.
    std::uint64_t waits = 0;        ///< 1: there was no room for the last layer; the next leaves when there is.

    bool operator==(const Flow&) const = default;
  };

  /// A layer that is not yet clear of its mouth: its particles have numbers firstId, firstId + 1, …
  struct Layer {
    double mouthSeconds = 0;  ///< When it passed the mouth.
    std::uint32_t firstId = 0;
    std::uint32_t count = 0;
    std::uint64_t nozzle = 0;

    bool operator==(const Layer&) const = default;
  };

  std::vector<Flow> flows;    ///< Of each nozzle.
  std::vector<Layer> held;    ///< By firstId.
  std::uint64_t nextId = 0;   ///< Of the next particle: numbers are never given twice.
  std::uint64_t drained = 0;  ///< Particles that have left the scene.

  bool operator==(const PopulationState&) const = default;
};

/// How particles come and go: the emitters and drains of a scene.
///
/// Layers of particles leave a nozzle at exact times, whatever the steps: one that passed the mouth within a step is
/// put where it has got to by the step's end, so that a jet has no gaps. Until it has come one support radius far, a
/// layer follows the parabola of free flight, whatever the solver says: it has no fluid behind it yet that would hold
/// it, and would be pushed back into the mouth. A body that comes in its way, or stands there, ends that: the solver
/// and the body then have the layer and those behind it. A layer that would stand in other particles or a body, where
/// that is now, or for which there are too many particles already, waits, and those after it too.
///
/// Used by one thread; loops run on the team. Particles, their numbers and their order do not depend on its size.
class Population {
 public:
  /// Throws core::InputError with the field path where a nozzle is no nozzle (see Nozzle) or its mouth is not inside
  /// the container, one spacing from its faces, and outside of bodies that never move, and where a drain lies outside
  /// the container. The bodies must outlive this.
  Population(const v1::Simulation& simulation, const Container& container, const Bodies& bodies,
             const MovingBodies& movingBodies, const Discretisation& discretisation);

  bool hasEmitters() const { return !nozzles_.empty(); }
  bool hasDrains() const { return !drains_.empty(); }
  bool changes() const { return hasEmitters() || hasDrains(); }

  /// Whether an emitter may give particles after `time`, s, or has a layer on its way.
  bool emitting(double time) const;

  /// At time 0. `particle` is one particle with every array that particles of the scene have, as new ones start;
  /// the first `particles` numbers are taken.
  void reset(ParticleState particle, std::uint64_t particles);

  /// Takes particles in drains out; the others keep their order.
  void drain(ParticleState& particles, const Team& team);

  struct Moment {
    double time = 0;  ///< End of the step, s.
    Eigen::Vector3d gravity = Eigen::Vector3d::Zero();
    std::uint64_t most = 0;  ///< Particles that the scene may have.
  };

  /// Moves layers on that are not yet clear of their mouths, and adds those that have passed theirs by now behind the
  /// other particles, once bodies have moved. Returns the largest speed of either, m/s.
  double emit(ParticleState& particles, const Moment& moment, const Team& team);

  const PopulationState& state() const { return state_; }
  void takeBack(const PopulationState& state) { state_ = state; }

  /// Numbers for `count` particles that come in another way: the first of them.
  std::uint32_t takeNumbers(std::uint64_t count);
  std::uint64_t numbersLeft() const;

  /// Particles that emitters have given so far.
  std::uint64_t emitted() const;

  void save(core::StateWriter& out) const;

  /// Throws InputError where what is read cannot be the state of this scene with the given particles.
  void resume(core::StateReader& in, const std::vector<std::uint32_t>& ids);

 private:
  bool isOver(std::size_t nozzle, double time) const;
  double moveHeld(ParticleState& particles, const Moment& moment, const Team& team) const;
  bool emitLayer(std::size_t nozzle, ParticleState& particles, const Moment& moment, const Team& team);
  bool hasRoom(const std::vector<Float4>& places, const Eigen::Vector3d& middle, double radius,
               const ParticleState& particles, const Team& team) const;
  bool isBlocked(const Eigen::Vector3d& place) const;
  void letGoAtBodies(const Moment& moment);
  void letGo(double time);

  const Bodies* bodies_;
  const MovingBodies* movingBodies_;
  double spacing_;
  double support_;
  std::vector<Nozzle> nozzles_;
  std::vector<Eigen::AlignedBox3f> drains_;  ///< In the container's coordinates.
  ParticleState particle_;
  PopulationState state_;
};

}  // namespace sluice::sim
