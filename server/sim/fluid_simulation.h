#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <string>

#include "boundary.h"
#include "cell_grid.h"
#include "initial_state.h"
#include "mixture.h"
#include "neighbour_lists.h"
#include "particles.h"
#include "pressure_solve.h"
#include "sluice/core/particle_source.h"
#include "sluice/sim/step_plan.h"
#include "sluice/v1/scene.pb.h"
#include "team.h"
#include "time_step.h"

namespace sluice::sim {

struct SimulationOptions {
  int threads = 0;                   ///< 0: one for each core.
  const PairLoops* loops = nullptr;  ///< Null: the fastest that this machine runs.
  /// Also run stages that a plan leaves out as having no effect (viscosity, gravity, boundary): for the tests that show
  /// that leaving them out changes nothing.
  bool keepInertStages = false;
};

/// DFSPH in a closed box [BK17: Bender & Koschier 2017, Divergence-free SPH for incompressible and viscous fluids].
/// A step runs the stages of its StepPlan, no others. A step that would leave a state that cannot be right is taken
/// back and tried again with half the length. Used by one thread; loops run on an OpenMP team.
class FluidSimulation : public core::ParticleSource {
 public:
  explicit FluidSimulation(const v1::Simulation& settings, const SimulationOptions& options = {});

  bool advance() override;
  double time() const override { return time_; }
  void reset() override;
  std::unique_ptr<core::ParticleSnapshot> snapshot() const override;
  void update(const v1::Scene& scene) override;
  std::string halted() const override { return halted_; }
  core::Plan plan() const override;

  /// The present particles, in the order of the last sort, relative to the container's lower corner.
  const ParticleState& state() const { return state_; }
  const NeighbourLists& neighbours() const { return lists_; }
  const BoxBoundary& boundary() const { return boundary_; }
  /// The fluids; the state's impulses times mixture().heaviest() over the step's length are pressures.
  const Mixture& mixture() const { return mixture_; }
  core::StepStatistics statistics() const override { return statistics_; }
  /// Particles that have been held at the container's faces by force, since the initial state.
  std::uint64_t wallContacts() const { return wallContacts_; }

 private:
  FluidSimulation(const v1::Simulation& settings, const SimulationOptions& options, int threads,
                  const Container& container, KernelKind kernel, double support, double volume);

  void checkOverlaps() const;
  bool tryStep();
  void run(Stage stage);
  void chooseLength();
  void solveDivergence();
  void applyViscosity();
  void applyGravity();
  void solveDensity();
  void scaleImpulses(std::vector<float>& impulse, double scale) const;
  void move();
  void sort();
  void computeFactors();
  void takeBack();
  void findBoundaryInReach();
  StepPlan currentPlan() const;

  v1::Simulation settings_;
  SimulationOptions options_;
  Team team_;
  Mixture mixture_;
  Container container_;
  double support_;
  double volume_;
  BoxBoundary boundary_;

  ParticleState state_;
  /// The state before the last sort, whose k-th particle is now grid_.order()'s: what a step is taken back to.
  ParticleState previous_;
  CellGrid grid_;
  NeighbourLists lists_;
  PressureSolve solver_;
  std::vector<float> factor_;            ///< α_i, m² (see PressureSolve).
  std::vector<float> divergenceFactor_;  ///< α_i, 0 near a free surface.
  std::vector<Float4> scratch_;

  double time_ = 0;
  TimeStepChoice length_;
  double lastStepSeconds_ = 0;  ///< Of the last step that was taken; 0 before the first.
  double recoverySeconds_ = std::numeric_limits<double>::infinity();
  double maxSpeed_ = 0;
  bool boundaryInReach_ = true;
  std::uint64_t wallContacts_ = 0;
  std::string trouble_;  ///< Why the step that is being tried cannot be taken.
  std::string halted_;
  core::StepStatistics statistics_;
};

}  // namespace sluice::sim
