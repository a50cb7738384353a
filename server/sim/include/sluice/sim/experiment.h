#pragma once

#include <functional>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "sluice/core/particle_source.h"
#include "sluice/v1/scene.pb.h"

namespace sluice::sim {

/// What a scene cannot say, for studies that compare with exact solutions.
struct Experiment {
  /// Where particles start, m, in the scene's coordinates, inside its container, in the place of the scene's own; their
  /// ids are their places here. They may overlap and coincide. In a planar scene all have the same z.
  std::vector<Eigen::Vector3d> positions = {};
  std::vector<Eigen::Vector3d> velocities = {};  ///< Of each, m/s; empty for rest.

  /// The container is one period of a flow without walls: particles that leave it at one side come in at the other, in
  /// a planar scene along x and y. It has to be three supports long at least.
  bool periodic = false;

  /// Length of every step, s, whatever the bounds on it say, to find out where they lie; after a step that had to be
  /// taken back, shorter. 0: as bounded.
  double forcedStep = 0;

  /// Acceleration at a position (m) and a time (s) besides gravity, m/s²; empty for none. Called from several threads.
  std::function<Eigen::Vector3d(const Eigen::Vector3d& position, double seconds)> acceleration = {};
};

/// A simulation of the experiment with the methods, the first fluid and the container of the scene. Its saved state
/// holds the particles, not the experiment. Throws core::InputError as makeSimulation does, with the paths
/// "experiment.positions" and "experiment.velocities" where particles are not finite or outside of the container.
std::unique_ptr<core::ParticleSource> makeExperiment(const v1::Scene& scene, Experiment experiment, int threads = 0);

}  // namespace sluice::sim
