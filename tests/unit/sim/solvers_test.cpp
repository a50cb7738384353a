// What every pressure solver has to get right, whatever its way.

#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes.h"
#include "sluice/core/input_error.h"

namespace sluice::sim {
namespace {

struct Method {
  const char* name;
  void (*choose)(v1::Simulation&);
  double densityError;   ///< Mean compression that it may leave.
  double restSpeed;      ///< Largest speed of a resting column, over √(gH).
  double pressureError;  ///< Of the pressure gradient in such a column, relative.
  double fallError;      ///< Of positions in free fall, m.
};

void chooseDeltaSph(v1::Simulation& simulation) { simulation.mutable_wcsph()->mutable_density_diffusion(); }

// Floats of 5 m resolve 2⁻²² m, and up to some hundred steps round; PBF corrects what the lattice's density is rounded
// by, 10⁻⁶.
constexpr double kRounding = 1e-4;

const Method kMethods[] = {
    {"Dfsph", [](v1::Simulation& simulation) { simulation.mutable_dfsph(); }, 0.001, 0.05, 0.2, kRounding},
    {"Iisph", [](v1::Simulation& simulation) { simulation.mutable_iisph(); }, 0.001, 0.05, 0.2, kRounding},
    // As stiff as its five iterations go: within 1 %.
    {"Pbf", [](v1::Simulation& simulation) { simulation.mutable_pbf(); }, 0.01, 0.1, 0.2, kRounding},
    // Compressible by 1 % at the speed that sound is ten times as fast as; the column swings about its rest.
    {"Wcsph", [](v1::Simulation& simulation) { simulation.mutable_wcsph(); }, 0.01, 0.1, 0.35, kRounding},
    // Its diffusion takes for granted that the fluid is near hydrostatic rest, which a falling cube is not.
    {"DeltaSph", chooseDeltaSph, 0.01, 0.1, 0.35, 2e-3},
};

class EverySolver : public testing::TestWithParam<Method> {
 protected:
  static v1::Simulation with(v1::Simulation simulation) {
    GetParam().choose(simulation);
    return simulation;
  }

  /// With sound no faster than it has to be for speeds of 3 m/s: the floating scenes have room for a long fall.
  static v1::Simulation withSlowSound(v1::Simulation simulation) {
    GetParam().choose(simulation);
    if (simulation.has_wcsph()) simulation.mutable_wcsph()->set_speed_of_sound(30);
    return simulation;
  }
};

TEST_P(EverySolver, AColumnStaysAtRest) {
  constexpr std::uint32_t kLayers = 10;
  v1::Simulation settings = with(column(6, kLayers));
  settings.mutable_fluids(0)->set_viscosity(0.05);
  FluidSimulation simulation(settings);
  runUntil(simulation, 0.6);
  ASSERT_EQ(simulation.halted(), "");
  double highest = 0;
  for (const Float4& x : simulation.state().position) highest = std::max(highest, static_cast<double>(x.y));
  // Settling moves the surface by less than a spacing.
  EXPECT_NEAR(highest, 0.05 * kLayers, 0.04);
  EXPECT_LT(simulation.statistics().meanDensityError, GetParam().densityError);
  EXPECT_LT(simulation.statistics().maxSpeed, GetParam().restSpeed * std::sqrt(9.81 * 0.05 * kLayers));
}

TEST_P(EverySolver, FreeFallIsExactForTheScheme) {
  v1::Simulation settings = withSlowSound(floatingCube(4));
  settings.mutable_gravity()->set_y(-9.81);
  FluidSimulation simulation(settings);
  const std::vector<Float4> before = positionsById(simulation);
  double velocity = 0;
  double fall = 0;
  while (simulation.time() < 0.3) {
    ASSERT_TRUE(simulation.advance());
    const double dt = simulation.statistics().timeStepSeconds;
    velocity -= 9.81 * dt;
    fall += velocity * dt;
  }
  EXPECT_LT(fall, -0.3);
  const std::vector<Float4> after = positionsById(simulation);
  const double error = GetParam().fallError;
  for (std::size_t i = 0; i < before.size(); ++i) {
    ASSERT_NEAR(after[i].x, before[i].x, error);
    ASSERT_NEAR(after[i].y, before[i].y + fall, error);
    ASSERT_NEAR(after[i].z, before[i].z, error);
  }
  double mean = 0;
  for (const Float4& v : simulation.state().velocity) mean += v.y / static_cast<double>(before.size());
  EXPECT_NEAR(mean, velocity, 1e-4);
}

TEST_P(EverySolver, MomentumIsKeptWithoutWallsAndGravity) {
  for (const double ratio : {1.0, 5.0}) {
    FluidSimulation simulation(withSlowSound(collidingFluids(ratio)));
    const auto momentum = [&] {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      const ParticleState& state = simulation.state();
      for (std::size_t i = 0; i < state.size(); ++i) {
        const double mass = simulation.mixture().restDensities()[state.fluid[i]] / 1000;
        sum += mass * Eigen::Vector3d(state.velocity[i].x, state.velocity[i].y, state.velocity[i].z);
      }
      return sum;
    };
    const Eigen::Vector3d before = momentum();
    const auto particles = static_cast<double>(simulation.state().size());
    runUntil(simulation, 0.1);
    ASSERT_EQ(simulation.halted(), "");
    // Velocities have changed by about 1 m/s; rounding each to 2⁻²⁴ in some hundred steps adds up to less than this.
    EXPECT_LT((momentum() - before).norm(), 1e-6 * (1 + ratio) * particles);
    double lowest = 10;
    for (const Float4& v : simulation.state().velocity) lowest = std::min(lowest, static_cast<double>(v.x));
    EXPECT_LT(std::abs(lowest + 1), 5) << "they have met, and not burst";
  }
}

TEST_P(EverySolver, SameBitsForAnyNumberOfThreadsAndAfterReset) {
  const v1::Simulation settings = with(smallDamBreak());
  const auto advanced = [](FluidSimulation& simulation) {
    for (int step = 0; step < 12; ++step) EXPECT_TRUE(simulation.advance());
    return simulation.state();
  };
  FluidSimulation alone(settings, {.threads = 1});
  const ParticleState one = advanced(alone);
  for (const int threads : {2, 4}) {
    FluidSimulation simulation(settings, {.threads = threads});
    EXPECT_TRUE(advanced(simulation) == one) << threads << " threads";
  }
  alone.reset();
  EXPECT_TRUE(advanced(alone) == one);
}

TEST_P(EverySolver, PressureInASnapshotIsHydrostatic) {
  constexpr std::uint32_t kLayers = 10;
  v1::Simulation settings = with(column(8, kLayers));
  settings.mutable_fluids(0)->set_viscosity(0.05);
  FluidSimulation simulation(settings);
  runUntil(simulation, 0.5);
  double sum[2] = {};
  double height[2] = {};
  double count[2] = {};
  // Over some time, because single steps flicker about the mean and compressible fluid swings.
  while (simulation.time() < 0.65) {
    ASSERT_TRUE(simulation.advance());
    const auto snapshot = simulation.snapshot();
    for (std::size_t i = 0; i < snapshot->size(); ++i) {
      const Eigen::Vector3f& x = snapshot->positions[i];
      // Particles next to the side walls carry more: a wall answers with κ_i only, not κ_i + κ_j.
      const auto inside = [](float place) { return place > 0.12F && place < 9 * 0.05F - 0.12F; };
      if (!inside(x.x()) || !inside(x.z())) continue;
      for (const int upper : {0, 1}) {
        const float low = upper == 0 ? 0.10F : 0.30F;
        if (x.y() < low || x.y() > low + 0.1F) continue;
        sum[upper] += snapshot->pressures[i];
        height[upper] += x.y();
        count[upper] += 1;
      }
    }
  }
  const double gradient =
      (sum[0] / count[0] - sum[1] / count[1]) / (height[1] / count[1] - height[0] / count[0]) / (1000 * 9.81);
  EXPECT_NEAR(gradient, 1, GetParam().pressureError);
}

TEST_P(EverySolver, BoundaryAndStagesAreThoseOfItsPlan) {
  FluidSimulation simulation(with(smallDamBreak()));
  std::vector<std::string> planned;
  for (const core::PlannedStage& stage : simulation.plan().stages) planned.push_back(stage.name);
  ASSERT_TRUE(simulation.advance());
  std::vector<std::string> timed;
  for (const core::StageTime& stage : simulation.statistics().stages) timed.push_back(stage.name);
  EXPECT_EQ(timed, planned);
}

TEST_P(EverySolver, ABlowUpIsTakenBackAndReported) {
  // Two cubes that meet at 200 m/s, with less work allowed than keeps them from each other, and no time either.
  v1::Simulation settings = with(floatingCube(8));
  v1::Block* left = settings.mutable_fluids(0)->mutable_blocks(0);
  v1::Block right = *left;
  left->mutable_first_particle()->set_x(-0.45);
  left->mutable_velocity()->set_x(100);
  right.mutable_first_particle()->set_x(0.05);
  right.mutable_velocity()->set_x(-100);
  *settings.mutable_fluids(0)->add_blocks() = right;
  settings.mutable_time_step()->set_min_seconds(1.5e-4);
  settings.mutable_time_step()->set_max_seconds(2e-4);
  settings.mutable_time_step()->set_max_compression(5);
  if (settings.has_dfsph()) settings.mutable_dfsph()->set_max_iterations(2);
  if (settings.has_iisph()) settings.mutable_iisph()->set_max_iterations(2);
  if (settings.has_pbf()) settings.mutable_pbf()->set_iterations(1);
  if (settings.has_wcsph()) settings.mutable_wcsph()->set_speed_of_sound(10);
  FluidSimulation simulation(settings);
  double time = 0;
  std::vector<Float4> good = positionsById(simulation);
  for (int step = 0; step < 40 && simulation.advance(); ++step) {
    good = positionsById(simulation);
    time = simulation.time();
  }
  ASSERT_NE(simulation.halted(), "");
  EXPECT_THAT(simulation.halted(), testing::HasSubstr("simulation.time_step.min_seconds"));
  EXPECT_EQ(positionsById(simulation), good);
  EXPECT_EQ(simulation.time(), time);
  const auto snapshot = simulation.snapshot();
  for (std::size_t i = 0; i < snapshot->size(); ++i) {
    ASSERT_TRUE(snapshot->positions[i].allFinite());
    ASSERT_TRUE(snapshot->velocities[i].allFinite());
    ASSERT_TRUE(std::isfinite(snapshot->densities[i]) && std::isfinite(snapshot->pressures[i]));
  }
}

INSTANTIATE_TEST_SUITE_P(Solvers, EverySolver, testing::ValuesIn(kMethods),
                         [](const auto& method) { return std::string(method.param.name); });

TEST(Wcsph, SoundBoundsItsStep) {
  v1::Simulation settings = column(6, 6);
  settings.mutable_wcsph()->set_speed_of_sound(40);
  FluidSimulation simulation(settings);
  ASSERT_TRUE(simulation.advance());
  EXPECT_EQ(simulation.statistics().timeStepLimit, "sound");
  EXPECT_DOUBLE_EQ(simulation.statistics().timeStepSeconds, 0.25 * 0.05 / 40);
}

TEST(Wcsph, SoundIsTenTimesAsFastAsAFallThroughTheTank) {
  v1::Simulation settings = column(6, 6);
  settings.mutable_wcsph();
  FluidSimulation simulation(settings);
  ASSERT_TRUE(simulation.advance());
  // The highest particle is 6 spacings above the floor.
  const double speedOfSound = 10 * std::sqrt(2 * 9.81 * 0.3);
  EXPECT_NEAR(simulation.statistics().timeStepSeconds, 0.25 * 0.05 / speedOfSound, 1e-8);
}

TEST(Wcsph, StretchedFluidPullsOnlyWhereItMay) {
  for (const bool pulls : {false, true}) {
    v1::Simulation settings = floatingCube(6);
    settings.mutable_wcsph()->set_speed_of_sound(20);
    settings.mutable_wcsph()->set_negative_pressure(pulls);
    // Two halves that fly apart.
    v1::Block* left = settings.mutable_fluids(0)->mutable_blocks(0);
    left->set_count_x(3);
    v1::Block right = *left;
    right.mutable_first_particle()->set_x(left->first_particle().x() + 3 * 0.05);
    left->mutable_velocity()->set_x(-0.1);
    right.mutable_velocity()->set_x(0.1);
    *settings.mutable_fluids(0)->add_blocks() = right;
    FluidSimulation simulation(settings);
    runUntil(simulation, 0.02);
    float fastest = 0;
    for (const Float4& v : simulation.state().velocity) fastest = std::max(fastest, std::abs(v.x));
    double relative = 0;
    for (std::size_t i = 0; i < simulation.state().size(); ++i) {
      relative += (simulation.state().id[i] < 108 ? -1 : 1) * simulation.state().velocity[i].x / 216;
    }
    if (pulls) {
      EXPECT_LT(relative, 0.08);
    } else {
      EXPECT_NEAR(relative, 0.1, 1e-4);
    }
  }
}

// The diffusion of density evens out what differs from the hydrostatic state, and nothing of that state itself.
TEST(Wcsph, DensityDiffusionKeepsTheHydrostaticCompression) {
  constexpr std::uint32_t kLayers = 10;
  v1::Simulation settings = column(6, kLayers);
  settings.mutable_fluids(0)->set_viscosity(0.05);
  settings.mutable_wcsph()->mutable_density_diffusion();
  FluidSimulation simulation(settings);
  runUntil(simulation, 0.8);
  ASSERT_EQ(simulation.halted(), "");
  // δρ/ρ0 = g (H - y)/c0², with c0² = 200 g H: half the height apart, the means of two halves differ by 1/400. It
  // swings.
  double difference = 0;
  int steps = 0;
  for (; simulation.time() < 1.0; ++steps) {
    ASSERT_TRUE(simulation.advance());
    for (std::size_t i = 0; i < simulation.state().size(); ++i) {
      const bool low = simulation.state().position[i].y < 0.05F * (kLayers + 1) / 2;
      difference += (low ? 2 : -2) * simulation.state().compression[i] / static_cast<double>(simulation.state().size());
    }
  }
  EXPECT_NEAR(difference / steps, 1.0 / 400, 0.25 / 400);
  // Without drift: the surface is where it was but for what settling takes.
  double mean = 0;
  for (const Float4& x : simulation.state().position) mean += x.y / static_cast<double>(simulation.state().size());
  EXPECT_NEAR(mean, 0.05 * (kLayers + 1) / 2, 0.01);
}

/// Mean difference between a particle's compression and those of its neighbours.
double roughness(const FluidSimulation& simulation) {
  const ParticleState& state = simulation.state();
  double variation = 0;
  for (std::size_t i = 0; i < state.size(); ++i) {
    double around = 0;
    int count = 0;
    for (std::size_t j = 0; j < state.size(); ++j) {
      const float dx = state.position[i].x - state.position[j].x;
      const float dy = state.position[i].y - state.position[j].y;
      const float dz = state.position[i].z - state.position[j].z;
      if (j == i || dx * dx + dy * dy + dz * dz > 0.075F * 0.075F) continue;
      around += state.compression[j];
      ++count;
    }
    if (count > 0) variation += std::abs(state.compression[i] - around / count) / static_cast<double>(state.size());
  }
  return variation;
}

TEST(Wcsph, DensityDiffusionSmoothsPressure) {
  double rough[2];
  for (const int diffusive : {0, 1}) {
    v1::Simulation settings = column(6, 10);
    settings.mutable_fluids(0)->set_viscosity(0.002);
    settings.mutable_wcsph();
    if (diffusive == 1) settings.mutable_wcsph()->mutable_density_diffusion();
    FluidSimulation simulation(settings);
    runUntil(simulation, 0.3);
    rough[diffusive] = roughness(simulation);
  }
  EXPECT_LT(rough[1], 0.6 * rough[0]);
}

TEST(Pbf, MoreIterationsMakeItStiffer) {
  double error[2];
  for (const std::uint32_t iterations : {1U, 8U}) {
    v1::Simulation settings = column(6, 10);
    settings.mutable_pbf()->set_iterations(iterations);
    FluidSimulation simulation(settings);
    runUntil(simulation, 0.3);
    error[iterations == 8] = simulation.statistics().meanDensityError;
  }
  EXPECT_LT(error[1], 0.5 * error[0]);
}

TEST(Solvers, CannotChangeWhileTheyRun) {
  v1::Simulation settings = smallDamBreak();
  FluidSimulation simulation(settings);
  settings.mutable_iisph();
  EXPECT_THROW(simulation.update(sceneOf(settings)), core::InputError);
}

TEST(Solvers, TakeUpdatesOfTheirOwn) {
  v1::Simulation settings = smallDamBreak();
  settings.mutable_pbf()->set_iterations(2);
  FluidSimulation simulation(settings);
  ASSERT_TRUE(simulation.advance());
  EXPECT_EQ(simulation.statistics().densityIterations, 2U);
  settings.mutable_pbf()->set_iterations(4);
  simulation.update(sceneOf(settings));
  ASSERT_TRUE(simulation.advance());
  EXPECT_EQ(simulation.statistics().densityIterations, 4U);
}

TEST(WendlandKernel, CarriesAColumn) {
  v1::Simulation settings = column(6, 8);
  settings.mutable_wendland_c2();
  settings.mutable_fluids(0)->set_viscosity(0.05);
  FluidSimulation simulation(settings);
  runUntil(simulation, 0.8);
  EXPECT_EQ(simulation.halted(), "");
  EXPECT_LT(simulation.statistics().meanDensityError, 0.002);
  EXPECT_LT(simulation.statistics().maxSpeed, 0.1 * std::sqrt(9.81 * 0.4));
}

}  // namespace
}  // namespace sluice::sim
