#include "sluice/sources/foam_source.h"

#include <omp.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "foam_grid.h"
#include "foam_particles.h"
#include "foam_potentials.h"
#include "foam_walls.h"

namespace sluice::sources {

namespace {

using Eigen::Vector3f;

/// Simulated time between two steps of the foam, s. A solver's steps are several times shorter; taking a snapshot and
/// searching neighbours at each would cost as much as the solver itself, and spray needs no steps at all to fly right.
constexpr double kInterval = 0.01;

constexpr const char* kPotentialsStage = "foam potentials";
constexpr const char* kParticlesStage = "foam particles";

/// Of a saved state.
constexpr std::string_view kPart = "foam";

Vector3f toVector(const v1::Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

/// Owned and used by one thread, as the source that it wraps.
class FoamSource : public core::ParticleSource {
 public:
  FoamSource(std::unique_ptr<core::ParticleSource> liquid, const v1::Scene& scene, int threads)
      : liquid_(std::move(liquid)), threads_(threads > 0 ? threads : omp_get_max_threads()), particles_(scene.seed()) {
    takeOver(scene);
    if (isOn_) walls_ = FoamWalls(scene);
    startAnew();
  }

  bool advance() override {
    stages_.clear();
    const bool moved = liquid_->advance();
    if (isOn_ && moved && hasVelocities_ && liquid_->time() - time_ >= kInterval * (1 - 1e-6)) step();
    return moved;
  }

  void stopAt(double seconds) override { liquid_->stopAt(seconds); }

  double time() const override { return liquid_->time(); }

  core::FlowMeasures measures() const override { return liquid_->measures(); }

  void reset() override {
    liquid_->reset();
    startAnew();
  }

  std::unique_ptr<core::ParticleSnapshot> snapshot() const override {
    std::unique_ptr<core::ParticleSnapshot> snapshot = liquid_->snapshot();
    if (!isOn_) return snapshot;
    snapshot->diffuse = particles_.all();
    snapshot->statistics = withStages(std::move(snapshot->statistics));
    // The liquid may have moved on since the last step: what it carries is drawn where it has come to.
    const auto seconds = static_cast<float>(liquid_->time() - time_);
    if (seconds <= 0) return snapshot;
    const FoamWalls walls = wallsOf(*snapshot);
    core::DiffuseParticles& diffuse = snapshot->diffuse;
    for (std::size_t i = 0; i < diffuse.size(); ++i) {
      Vector3f position = diffuse.positions[i] + seconds * diffuse.velocities[i];
      if (diffuse.kinds[i] == core::DiffuseKind::Spray) position += 0.5F * seconds * seconds * life_.gravity;
      Vector3f velocity = diffuse.velocities[i];
      walls.hold(diffuse.positions[i], position, velocity);
      diffuse.positions[i] = position;
    }
    return snapshot;
  }

  core::StepStatistics statistics() const override { return withStages(liquid_->statistics()); }

  void update(const v1::Scene& scene) override {
    liquid_->update(scene);
    const bool wasOn = isOn_;
    takeOver(scene);
    if (isOn_ == wasOn) return;
    // Walls themselves do not change while a source runs.
    if (isOn_) walls_ = FoamWalls(scene);
    startAnew();
  }

  void interact(const core::Interaction& interaction) override { liquid_->interact(interaction); }

  std::string halted() const override { return liquid_->halted(); }

  void save(core::StateWriter& out) const override {
    liquid_->save(out);
    out.write(kPart);
    out.write(std::uint8_t{isOn_});
    out.write(std::uint8_t{hasVelocities_});
    out.write(time_);
    out.write(stepsTaken_);
    particles_.save(out);
  }

  void resume(core::StateReader& in) override {
    liquid_->resume(in);
    in.expect(kPart);
    std::uint8_t isOn = 0;
    in.read(isOn);
    if ((isOn != 0) != isOn_) in.fail("the state and its scene disagree on whether there is foam");
    std::uint8_t hasVelocities = 0;
    in.read(hasVelocities);
    hasVelocities_ = hasVelocities != 0;
    in.read(time_);
    in.read(stepsTaken_);
    particles_.resume(in);
    stages_.clear();
  }

  std::vector<std::string> notices() const override { return liquid_->notices(); }

  core::Plan plan() const override {
    core::Plan plan = liquid_->plan();
    if (!isOn_ || !hasVelocities_) {
      const char* reason = isOn_ ? "the source gives no velocities" : "the scene has no foam";
      plan.leftOut.push_back({kPotentialsStage, reason});
      plan.leftOut.push_back({kParticlesStage, reason});
      return plan;
    }
    if (makesAny()) {
      plan.stages.push_back({kPotentialsStage, {"positions", "velocities"}, {"foam rates"}});
    } else {
      plan.leftOut.push_back({kPotentialsStage, "foam.trapped_air and foam.wave_crests are 0"});
    }
    plan.stages.push_back({kParticlesStage, {"positions", "velocities", "foam rates"}, {"foam"}});
    constexpr std::size_t kEach =
        2 * sizeof(Vector3f) + sizeof(core::DiffuseKind) + sizeof(float) + sizeof(std::uint32_t);
    plan.buffers.push_back({"foam", kEach * life_.most});
    return plan;
  }

 private:
  void takeOver(const v1::Scene& scene) {
    isOn_ = scene.has_foam();
    const v1::Foam& foam = scene.foam();
    rates_ = {static_cast<float>(foam.trapped_air()), static_cast<float>(foam.wave_crests())};
    life_.lifetime = static_cast<float>(foam.lifetime_seconds());
    life_.buoyancy = static_cast<float>(foam.buoyancy());
    life_.drag = static_cast<float>(foam.drag());
    life_.most = foam.max_particles();
    // Stored liquid has the gravity that nearly every simulation has.
    life_.gravity = scene.has_simulation() ? toVector(scene.simulation().gravity()) : FoamLife().gravity;
  }

  /// The walls, with the bodies where a snapshot has them.
  FoamWalls wallsOf(const core::ParticleSnapshot& snapshot) const {
    FoamWalls walls = walls_;
    walls.moveBodies(snapshot.bodies);
    return walls;
  }

  void startAnew() {
    particles_.clear();
    stages_.clear();
    time_ = liquid_->time();
    if (!isOn_) return;
    const std::unique_ptr<core::ParticleSnapshot> start = liquid_->snapshot();
    hasVelocities_ = !start->velocities.empty() || start->size() == 0;
    stepsTaken_ = start->statistics.steps;
  }

  bool makesAny() const { return rates_.trappedAir > 0 || rates_.waveCrests > 0; }

  void step() {
    const std::unique_ptr<core::ParticleSnapshot> liquid = liquid_->snapshot();
    const auto seconds = static_cast<float>(liquid->time - time_);
    time_ = liquid->time;
    // A sequence that starts again: what its last frames made has no part in the first.
    if (liquid->statistics.steps < stepsTaken_) particles_.clear();
    stepsTaken_ = liquid->statistics.steps;
    hasVelocities_ = liquid->velocities.size() == liquid->size();
    if (!hasVelocities_) return;

    const FoamWalls walls = wallsOf(*liquid);
    const FoamScales scales = foamScales(liquid->size(), liquid->spacing, static_cast<double>(life_.gravity.norm()));
    {
      const core::StageTimer timer(stages_, kPotentialsStage);
      grid_.build(liquid->positions, liquid->velocities, scales.support, threads_);
      if (makesAny()) potentials_.compute(grid_, walls, scales, rates_, threads_);
    }
    const core::StageTimer timer(stages_, kParticlesStage);
    particles_.advance(grid_, walls, scales, life_, seconds, threads_);
    if (makesAny()) particles_.create(grid_, potentials_, liquid->ids, walls, scales, seconds);
    particles_.keepAtMost(life_.most);
  }

  core::StepStatistics withStages(core::StepStatistics statistics) const {
    for (const core::StageTime& stage : stages_) {
      core::addStageTime(statistics.stages, stage.name, stage.milliseconds);
    }
    return statistics;
  }

  std::unique_ptr<core::ParticleSource> liquid_;
  int threads_;
  bool isOn_ = false;
  bool hasVelocities_ = true;
  FoamRates rates_;
  FoamLife life_;
  FoamWalls walls_;

  LiquidGrid grid_;
  FoamPotentials potentials_;
  FoamParticles particles_;
  double time_ = 0;  ///< Of the particles, s.
  std::uint64_t stepsTaken_ = 0;
  core::StageTimes stages_;  ///< Of the last step, where it moved the foam too.
};

}  // namespace

std::unique_ptr<core::ParticleSource> withFoam(std::unique_ptr<core::ParticleSource> liquid, const v1::Scene& scene,
                                               int threads) {
  return std::make_unique<FoamSource>(std::move(liquid), scene, threads);
}

}  // namespace sluice::sources
