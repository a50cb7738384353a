#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "sluice/core/stage_times.h"

namespace sluice::core {

/// How the last time step went.
struct StepStatistics {
  std::uint64_t steps = 0;     ///< Steps since the initial state.
  double timeStepSeconds = 0;  ///< Length of the last step, s.
  std::string timeStepLimit;   ///< The bound that set it: "cfl", "max_seconds", …
  std::uint32_t densityIterations = 0;
  std::uint32_t divergenceIterations = 0;
  std::uint32_t viscosityIterations = 0;  ///< Of implicit viscosity; 0 where it did not run.
  double meanDensityError = 0;            ///< Mean compression relative to the rest density (0.0005 is 0.05 %).
  double maxDensityError = 0;             ///< Largest compression of any particle, likewise.
  double maxSpeed = 0;                    ///< m/s.
  StageTimes stages;                      ///< Milliseconds of each stage of the last step.
};

/// What a secondary particle is: it moves, ages and looks accordingly.
enum class DiffuseKind : std::uint8_t { Spray, Foam, Bubble };

/// Secondary particles of air and water, far smaller than those of the liquid. Every array has one element for each.
struct DiffuseParticles {
  std::vector<Eigen::Vector3f> positions;   ///< m; finite.
  std::vector<Eigen::Vector3f> velocities;  ///< m/s.
  std::vector<DiffuseKind> kinds;
  std::vector<float> remaining;    ///< Share of its lifetime that is left, (0, 1].
  std::vector<std::uint32_t> ids;  ///< Stable over time.

  std::size_t size() const { return positions.size(); }
};

/// Where a body of the scene is.
struct BodyPose {
  Eigen::Vector3f position = Eigen::Vector3f::Zero();  ///< m.
  Eigen::Quaternionf rotation = Eigen::Quaternionf::Identity();
};

/// The particles at one moment, frozen: made by one thread, read by any. Structure of arrays; every array is either
/// empty (the source does not know it) or has one element per particle, and all arrays share one order.
struct ParticleSnapshot {
  std::uint64_t sequence = 0;         ///< Counts snapshots of one run of the program; never repeats.
  double time = 0;                    ///< Simulated time, s.
  double spacing = 0;                 ///< Initial particle spacing d, m; > 0.
  double restDensity = 1000;          ///< kg/m³.
  std::vector<double> restDensities;  ///< Of each fluid, kg/m³, where there are several.

  std::vector<Eigen::Vector3f> positions;   ///< m; finite.
  std::vector<Eigen::Vector3f> velocities;  ///< m/s.
  std::vector<float> densities;             ///< kg/m³.
  std::vector<std::uint32_t> ids;           ///< Stable over time, whatever the order of the arrays.
  std::vector<float> pressures;             ///< Pa.
  std::vector<float> ages;                  ///< Time since the particle came into the scene, s.
  std::vector<std::uint8_t> fluids;         ///< Which fluid it is of; empty where there is but one.

  double supportRadius = 0;               ///< Distance up to which `neighbours` counts, m.
  std::vector<std::uint16_t> neighbours;  ///< Other particles of the fluid, walls not among them.

  DiffuseParticles diffuse;      ///< Empty where the scene has no foam.
  std::vector<BodyPose> bodies;  ///< One for each body of the scene, or empty: all stand where the scene puts them.

  /// Axis-aligned bounds of `positions`; empty for no particles.
  Eigen::AlignedBox3f bounds;

  StepStatistics statistics;

  std::size_t size() const { return positions.size(); }
};

/// The bounds of a set of points.
Eigen::AlignedBox3f boundsOf(const std::vector<Eigen::Vector3f>& positions);

}  // namespace sluice::core
