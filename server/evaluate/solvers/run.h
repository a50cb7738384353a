#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "sluice/core/particle_source.h"
#include "sluice/sim/experiment.h"
#include "sluice/v1/scene.pb.h"
#include "solvers/method.h"

namespace sluice::evaluate {

/// One figure of a run beside what it should be.
struct Finding {
  std::string norm;       ///< What `error` is: "L2 of pressure".
  double error = 0;       ///< 0 is exact.
  std::string reference;  ///< Where the true value comes from.
};

/// Drives a simulation and counts what it costs. The time of looking at the particles is not counted.
class Run {
 public:
  /// `resolution`: particles along the length that the case is cut by.
  Run(Method method, int resolution, int threads) : method_(method), resolution_(resolution), threads_(threads) {}

  const Method& method() const { return method_; }
  int resolution() const { return resolution_; }

  /// Sets the scene's solver, and starts it.
  void start(v1::Scene scene);
  void start(v1::Simulation simulation);
  void start(v1::Simulation simulation, sim::Experiment experiment);

  /// Runs up to a time, calling `each` after every step. Returns false where the simulation halted before.
  bool runTo(double seconds, const std::function<void(const core::ParticleSource&)>& each = {});

  const core::ParticleSource& source() const { return *source_; }
  std::unique_ptr<core::ParticleSnapshot> particles() const { return source_->snapshot(); }
  double time() const { return source_->time(); }

  std::uint64_t steps() const { return steps_; }
  std::uint64_t iterations() const { return iterations_; }  ///< Of all solves of all steps.
  double wallSeconds() const { return wallSeconds_; }
  double meanStep() const { return steps_ > 0 ? time() / static_cast<double>(steps_) : 0; }
  double spacing() const { return spacing_; }
  std::size_t particleCount() const { return particleCount_; }

 private:
  void adopt(std::unique_ptr<core::ParticleSource> source);

  Method method_;
  int resolution_;
  int threads_;
  std::unique_ptr<core::ParticleSource> source_;
  double spacing_ = 0;
  std::size_t particleCount_ = 0;
  std::uint64_t steps_ = 0;
  std::uint64_t iterations_ = 0;
  double wallSeconds_ = 0;
};

/// A flow whose course is known. Adding one means a Case in the file of its family and its line in solverCases().
struct Case {
  std::string_view name;
  std::vector<int> quick;  ///< Resolutions of a quick sweep, rising; empty: only in a full one.
  std::vector<int> full;   ///< Of a full one.
  /// Whether a solver can run it at all, and at that resolution in the hour that a full sweep may take.
  bool (*applies)(const Method& method, int resolution);
  std::vector<Finding> (*run)(Run& run);  ///< Findings of a run that came to its end; none where it halted.
};

/// Every case, in the order of the study.
const std::vector<Case>& solverCases();

const Case& solverCase(std::string_view name);

// The families, a file each.
std::vector<Case> restCases();          ///< Free fall, hydrostatic columns.
std::vector<Case> viscousCases();       ///< Poiseuille, Couette, Taylor–Green.
std::vector<Case> freeSurfaceCases();   ///< Rotating square, elliptic drop, oscillating drop.
std::vector<Case> damBreakCases();      ///< Dam break.
std::vector<Case> boxImpactCases();     ///< Dam break against a box.
std::vector<Case> tensionCases();       ///< Droplets.
std::vector<Case> waveCases();          ///< Standing wave.
std::vector<Case> conservationCases();  ///< Momentum, angular momentum, energy.

inline bool everySolver(const Method&, int) { return true; }

}  // namespace sluice::evaluate
