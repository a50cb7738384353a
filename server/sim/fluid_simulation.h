#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "adhesion.h"
#include "bodies.h"
#include "body_contacts.h"
#include "boundary.h"
#include "cell_grid.h"
#include "container.h"
#include "discretisation.h"
#include "free_flight.h"
#include "initial_state.h"
#include "memory_budget.h"
#include "micropolar.h"
#include "mixture.h"
#include "moving_bodies.h"
#include "moving_boundary.h"
#include "neighbour_lists.h"
#include "particles.h"
#include "population.h"
#include "pressure_solver.h"
#include "sluice/core/particle_source.h"
#include "sluice/sim/experiment.h"
#include "sluice/sim/step_plan.h"
#include "sluice/v1/scene.pb.h"
#include "surface_tension.h"
#include "team.h"
#include "time_step.h"
#include "touch.h"
#include "viscosity_explicit.h"
#include "viscosity_weiler2018.h"
#include "walls.h"

namespace sluice::sim {

struct SimulationOptions {
  int threads = 0;                   ///< 0: one for each core.
  const PairLoops* loops = nullptr;  ///< Null: the fastest that this machine runs.
  /// Also run stages that a plan leaves out as having no effect (viscosity, gravity, boundary, …): for the tests that
  /// show that leaving them out changes nothing.
  bool keepInertStages = false;
  std::uint64_t availableMemory = 0;                       ///< Bytes; 0: what the machine can give.
  std::uint64_t mostParticles = 0;                         ///< 0: as many as there is memory for.
  VolumeFit volumeFit = VolumeFit::AsGiven;                ///< Of the scene's volumes.
  std::shared_ptr<const Experiment> experiment = nullptr;  ///< What stands in for parts of the scene; null for nothing.
};

/// SPH in a closed box, around bodies. A step runs the stages of its StepPlan, no others; which they are follows from
/// the methods that the scene chooses. A step that would leave a state that cannot be right is taken back and tried
/// again with half the length. Used by one thread; loops run on an OpenMP team.
class FluidSimulation : public core::ParticleSource {
 public:
  explicit FluidSimulation(const v1::Simulation& settings, const SimulationOptions& options = {})
      : FluidSimulation(settings, {}, options) {}

  /// With the scene's bodies, which fluid flows around and floats. `update` leaves them alone.
  FluidSimulation(const v1::Simulation& settings, const Bodies::List& bodies, const SimulationOptions& options = {});

  bool advance() override;
  void stopAt(double seconds) override { stop_ = seconds; }
  double time() const override { return time_; }
  void reset() override;
  std::unique_ptr<core::ParticleSnapshot> snapshot() const override;
  void update(const v1::Scene& scene) override;
  /// Acts on particles, not on bodies.
  void interact(const core::Interaction& interaction) override;
  /// The particles with what solvers carry from step to step, the cells that they are sorted by, and the time step's
  /// memory. Pairs, sums and factors follow from these.
  void save(core::StateWriter& out) const override;
  void resume(core::StateReader& in) override;
  std::string halted() const override { return halted_; }
  core::Plan plan() const override;
  std::vector<std::string> notices() const override;

  /// The present particles, in the order of the last sort, relative to the container's lower corner.
  const ParticleState& state() const { return state_; }
  const NeighbourLists& neighbours() const { return lists_; }
  const Boundary& boundary() const { return boundary_; }
  const Bodies& bodies() const { return bodies_; }
  const Population& population() const { return population_; }
  const MovingBodies& movingBodies() const { return movingBodies_; }
  /// The fluids; the state's impulses times mixture().heaviest() over the step's length are pressures.
  const Mixture& mixture() const { return mixture_; }
  core::StepStatistics statistics() const override { return statistics_; }
  core::FlowMeasures measures() const override;
  /// Particles that have been held at walls by force, since the initial state.
  std::uint64_t wallContacts() const { return wallContacts_; }

 private:
  void checkOverlaps(const InitialState& initial) const;
  InitialState beginning() const;
  InitialState startAnew();
  void findPairs();
  ParticleState newParticle() const;
  std::uint64_t mostParticles() const;
  bool keepsBirths() const { return population_.hasEmitters() || added_ > 0; }
  bool hasForceField() const { return options_.experiment && options_.experiment->acceleration; }
  Eigen::Vector3d fieldAt(const Float4& position) const;
  double largestAcceleration() const;
  /// That of the solver in two dimensions; in three, pools between mirrors were seen to come less to rest. Moving
  /// bodies answer once, and what is between a wall and a body must not be pressed into the one by the other.
  WallAnswer wallAnswer() const {
    return discretisation_.dimensions == 2 && movingBodies_.empty() ? solver_->wallAnswer() : WallAnswer::Once;
  }
  std::vector<float> wallShares() const;
  TimeStepInputs timeStepInputs() const;
  TimeStepChoice chooseLength() const;
  StepTraits traits(const TimeStepChoice& length) const;
  StepPlan planFor(const TimeStepChoice& length) const;
  StepContext beginStep();
  bool tryStep();
  void finish(const StepContext& step);
  void followMomentum(const StepPlan& plan, double seconds);
  void run(Stage stage, StepContext& step);
  void acceptLength(StepContext& step) const;
  void applyGravity(const StepContext& step);
  void applyField(const StepContext& step);
  void applyTouch(const StepContext& step);
  void move(StepContext& step);
  void emit(StepContext& step);
  std::vector<const solids::PlacedBody*> presentBodies() const;
  Eigen::Vector3d ballCentre(const TouchRay& ray, double radius) const;
  void addBall(std::uint32_t fluid, const TouchRay& ray, const std::optional<Eigen::Vector3d>& crossing, double radius);
  void append(const std::vector<Float4>& places, std::uint32_t fluid);
  double endOfStep() const { return reachesStop_ ? stop_ : time_ + stepSeconds_; }
  void sort();
  void findNeighbours();
  void measureCompression();
  void takeBack();
  void shortenToStop();
  void readParticles(core::StateReader& in);
  void rebuildPairs();
  void findBoundaryInReach();
  void updateMovingBoundary(StepContext& step);

  v1::Simulation settings_;
  SimulationOptions options_;
  Team team_;
  Mixture mixture_;
  Container container_;
  Discretisation discretisation_;
  Bodies bodies_;
  Boundary boundary_;
  MovingBodies movingBodies_;
  MovingBoundary movingBoundary_;
  BodyContacts contacts_;
  BodyStep bodyStep_;
  MovingBodies::State bodiesBefore_;  ///< At the step's beginning.
  Walls walls_;
  ParticleLimit particleLimit_;
  Population population_;
  Touch touch_;
  std::uint64_t added_ = 0;  ///< Particles that hands have added since the initial state.

  ParticleState state_;
  /// The state before the last sort, whose k-th particle is now grid_.order()'s: what a step is taken back to.
  ParticleState previous_;
  /// The state at the step's beginning, where previous_ is not: where the solver still moves particles after they are
  /// sorted, and where the step before has not sorted them.
  ParticleState beginning_;
  PopulationState populationBefore_;  ///< At the step's beginning, likewise.
  bool sortedInStep_ = false;
  bool keepsBeginning_ = false;
  CellGrid grid_;
  NeighbourLists lists_;
  FreeFlight freeFlight_;

  std::unique_ptr<PressureSolver> solver_;
  ExplicitViscosity explicitViscosity_;
  ImplicitViscosity implicitViscosity_;
  std::unique_ptr<SurfaceTension> surfaceTension_;
  Adhesion adhesion_;
  MicropolarModel micropolar_;

  double time_ = 0;
  double stop_ = std::numeric_limits<double>::infinity();  ///< Time that no step passes, s.
  TimeStepChoice length_;
  double stepSeconds_ = 0;      ///< What the step takes of it.
  bool reachesStop_ = false;    ///< The step ends at stop_.
  double lastStepSeconds_ = 0;  ///< Of the last step that was taken; 0 before the first.
  double recoverySeconds_ = std::numeric_limits<double>::infinity();
  double maxSpeed_ = 0;
  double pressureAcceleration_ = 0;  ///< Of explicit pressure forces in the last step, m/s².
  bool boundaryInReach_ = true;
  bool bodiesInReach_ = false;
  std::uint64_t wallContacts_ = 0;
  std::optional<Eigen::Vector3d> momentum_;                  ///< After the last step, kg·m/s, where it was followed.
  Eigen::Vector3d momentumDrift_ = Eigen::Vector3d::Zero();  ///< See core::FlowMeasures, kg·m/s.
  std::string halted_;
  std::vector<std::uint64_t> takenOut_;  ///< Of each body: particles that it leaves no room for at the start.
  std::uint64_t misfits_ = 0;            ///< Particles that were left out at the start, see VolumeFit.
  core::StepStatistics statistics_;
};

}  // namespace sluice::sim
