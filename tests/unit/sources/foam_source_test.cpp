#include "sluice/sources/foam_source.h"

#include <functional>
#include <set>
#include <utility>

#include <gmock/gmock.h>

#include "foam_support.h"
#include "sluice/scene/scene.h"

namespace sluice::sources::test {
namespace {

using testing::Contains;
using testing::Field;

/// Two halves of a cube that collide again and again: each step shows the same liquid a little later.
class Collision : public core::ParticleSource {
 public:
  explicit Collision(double step = 0.01) : cube_(12, colliding), step_(step) {}

  bool advance() override {
    time_ += step_;
    return true;
  }
  double time() const override { return time_; }
  void reset() override { time_ = 0; }
  std::unique_ptr<core::ParticleSnapshot> snapshot() const override {
    ++snapshots;
    auto snapshot = std::make_unique<core::ParticleSnapshot>();
    snapshot->time = time_;
    snapshot->spacing = static_cast<double>(cube_.spacing);
    snapshot->positions = cube_.positions;
    if (hasVelocities) snapshot->velocities = cube_.velocities;
    if (share) {
      // Particles come and go: so many of them at this time.
      const auto present = static_cast<std::size_t>(share(time_) * static_cast<double>(cube_.positions.size()));
      snapshot->positions.resize(present);
      if (hasVelocities) snapshot->velocities.resize(present);
    }
    return snapshot;
  }
  core::StepStatistics statistics() const override { return {}; }
  void update(const v1::Scene&) override { ++updates; }
  core::Plan plan() const override { return {}; }

  bool hasVelocities = true;
  std::function<double(double)> share;  ///< Of the cube's particles that there are at a time; all where it is not set.
  int updates = 0;
  mutable int snapshots = 0;

 private:
  Cube cube_;
  double step_;
  double time_ = 0;
};

v1::Scene foamyScene() {
  v1::Scene scene;
  scene.mutable_foam();
  scene.mutable_particle_file()->set_path("stored.bgeo");
  scene::complete(scene);
  return scene;
}

core::DiffuseParticles foamAfter(core::ParticleSource& source, int steps) {
  for (int i = 0; i < steps; ++i) source.advance();
  return source.snapshot()->diffuse;
}

void expectSame(const core::DiffuseParticles& a, const core::DiffuseParticles& b) {
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.velocities, b.velocities);
  EXPECT_EQ(a.kinds, b.kinds);
  EXPECT_EQ(a.remaining, b.remaining);
  EXPECT_EQ(a.ids, b.ids);
}

// Emitters and drains: from nothing to all, to nothing, and to all again.
TEST(FoamSource, CopesWithLiquidThatComesAndGoes) {
  const auto run = [](int threads) {
    auto liquid = std::make_unique<Collision>();
    liquid->share = [](double time) { return std::abs(std::sin(15 * time)) > 0.3 ? std::abs(std::sin(15 * time)) : 0; };
    const auto foamy = withFoam(std::move(liquid), foamyScene(), threads);
    EXPECT_EQ(foamy->snapshot()->size(), 0U);
    std::set<std::uint32_t> former;
    std::uint32_t next = 0;
    std::size_t most = 0;
    for (int step = 0; step < 60; ++step) {
      const core::DiffuseParticles foam = foamAfter(*foamy, 1);
      std::set<std::uint32_t> present(foam.ids.begin(), foam.ids.end());
      EXPECT_EQ(present.size(), foam.size());
      for (const std::uint32_t id : present) EXPECT_TRUE(former.contains(id) || id >= next) << "given again";
      if (!present.empty()) next = std::max(next, *present.rbegin() + 1);
      most = std::max(most, present.size());
      former = std::move(present);
    }
    EXPECT_GT(most, 50U);
    return foamy->snapshot()->diffuse;
  };
  expectSame(run(1), run(3));
}

TEST(FoamSource, GivesTheSameBitsForAnyNumberOfThreads) {
  const auto run = [](int threads) {
    return foamAfter(*withFoam(std::make_unique<Collision>(), foamyScene(), threads), 20);
  };
  const core::DiffuseParticles one = run(1);
  EXPECT_GT(one.size(), 500U);
  expectSame(run(2), one);
  expectSame(run(4), one);
}

TEST(FoamSource, FollowsTheSeed) {
  v1::Scene other = foamyScene();
  other.set_seed(7);
  const auto a = foamAfter(*withFoam(std::make_unique<Collision>(), foamyScene()), 5);
  const auto b = foamAfter(*withFoam(std::make_unique<Collision>(), other), 5);
  EXPECT_NE(a.positions, b.positions);
}

TEST(FoamSource, MakesTheSameAgainAfterAReset) {
  const auto source = withFoam(std::make_unique<Collision>(), foamyScene());
  const core::DiffuseParticles first = foamAfter(*source, 8);
  source->reset();
  EXPECT_EQ(source->snapshot()->diffuse.size(), 0U);
  expectSame(foamAfter(*source, 8), first);
}

TEST(FoamSource, GivesOnlyFiniteParticlesInTheirRanges) {
  const core::DiffuseParticles foam = foamAfter(*withFoam(std::make_unique<Collision>(), foamyScene()), 30);
  ASSERT_GT(foam.size(), 0U);
  for (std::size_t i = 0; i < foam.size(); ++i) {
    EXPECT_TRUE(foam.positions[i].allFinite() && foam.velocities[i].allFinite());
    EXPECT_GT(foam.remaining[i], 0);
    EXPECT_LE(foam.remaining[i], 1);
  }
}

TEST(FoamSource, KeepsToItsBudget) {
  v1::Scene scene = foamyScene();
  scene.mutable_foam()->set_max_particles(100);
  EXPECT_EQ(foamAfter(*withFoam(std::make_unique<Collision>(), scene), 30).size(), 100U);
}

TEST(FoamSource, StepsNoMoreOftenThanAHundredTimesASecond) {
  auto liquid = std::make_unique<Collision>(0.001);
  const Collision& watched = *liquid;
  const auto source = withFoam(std::move(liquid), foamyScene());
  const int before = watched.snapshots;
  for (int i = 0; i < 100; ++i) source->advance();
  EXPECT_EQ(watched.snapshots - before, 10);
}

TEST(FoamSource, CarriesParticlesOnBetweenItsSteps) {
  const auto source = withFoam(std::make_unique<Collision>(0.004), foamyScene());
  for (int i = 0; i < 6; ++i) source->advance();
  const core::DiffuseParticles at = source->snapshot()->diffuse;
  source->advance();  // 28 ms: the last step was at 24
  const core::DiffuseParticles later = source->snapshot()->diffuse;
  ASSERT_EQ(at.ids, later.ids);
  ASSERT_GT(at.size(), 0U);
  for (std::size_t i = 0; i < at.size(); ++i) {
    const Eigen::Vector3f moved = later.positions[i] - at.positions[i];
    EXPECT_LT((moved - 0.004F * at.velocities[i]).norm(), 1e-3F);
  }
}

TEST(FoamSource, MakesNothingWhenBothRatesAreZero) {
  v1::Scene scene = foamyScene();
  scene.mutable_foam()->set_trapped_air(0);
  scene.mutable_foam()->set_wave_crests(0);
  const auto source = withFoam(std::make_unique<Collision>(), scene);
  EXPECT_EQ(foamAfter(*source, 10).size(), 0U);
  EXPECT_THAT(source->plan().leftOut, Contains(Field(&core::LeftOut::name, "foam potentials")));
}

TEST(FoamSource, CostsNothingWithoutFoam) {
  v1::Scene scene = foamyScene();
  scene.clear_foam();
  auto liquid = std::make_unique<Collision>();
  const Collision& watched = *liquid;
  const auto source = withFoam(std::move(liquid), scene);
  for (int i = 0; i < 10; ++i) source->advance();
  EXPECT_EQ(watched.snapshots, 0);
  EXPECT_EQ(source->snapshot()->diffuse.size(), 0U);
  EXPECT_THAT(source->plan().leftOut, Contains(core::LeftOut{"foam potentials", "the scene has no foam"}));
  EXPECT_TRUE(source->plan().stages.empty());
}

TEST(FoamSource, IsSwitchedOnAndOffLive) {
  v1::Scene without = foamyScene();
  without.clear_foam();
  auto liquid = std::make_unique<Collision>();
  const Collision& watched = *liquid;
  const auto source = withFoam(std::move(liquid), without);
  source->advance();
  source->update(foamyScene());
  EXPECT_EQ(watched.updates, 1);
  EXPECT_GT(foamAfter(*source, 5).size(), 0U);
  EXPECT_THAT(source->plan().stages, Contains(Field(&core::PlannedStage::name, "foam particles")));
  source->update(without);
  EXPECT_EQ(foamAfter(*source, 5).size(), 0U);
}

TEST(FoamSource, SaysThatVelocitiesAreMissing) {
  auto liquid = std::make_unique<Collision>();
  liquid->hasVelocities = false;
  const auto source = withFoam(std::move(liquid), foamyScene());
  EXPECT_EQ(foamAfter(*source, 5).size(), 0U);
  EXPECT_THAT(source->plan().leftOut, Contains(core::LeftOut{"foam potentials", "the source gives no velocities"}));
}

TEST(FoamSource, TellsWhatItsStepsCost) {
  const auto source = withFoam(std::make_unique<Collision>(), foamyScene());
  source->advance();
  EXPECT_THAT(source->statistics().stages, Contains(Field(&core::StageTime::name, "foam potentials")));
}

}  // namespace
}  // namespace sluice::sources::test
