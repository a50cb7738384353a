// Scenes as people write them that cannot be simulated: each is told where it is wrong, and why.

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fluid_simulation.h"
#include "memory_budget.h"
#include "sluice/core/input_error.h"
#include "sluice/scene/scene.h"
#include "sluice/sim/simulation.h"

namespace sluice::sim {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

/// A tank of 3 m with what is given in it.
std::string tank(const std::string& fluids) {
  return "simulation {\n  particle_spacing: 0.05\n  max_particles: 100000000\n"
         "  container { min { x: 0 y: 0 z: 0 } max { x: 3 y: 3 z: 3 } }\n" +
         fluids + "}\n";
}

std::string block(const std::string& counts) {
  return "fluids { blocks { first_particle { x: 0.05 y: 0.05 z: 0.05 } " + counts + " } }\n";
}

core::InputError errorOf(const std::string& text, std::uint64_t mostParticles = 0) {
  try {
    makeSimulation(scene::parse(text, "tank.textproto"), 1, mostParticles);
  } catch (const core::InputError& error) {
    return error;
  }
  ADD_FAILURE() << "taken: " << text;
  return {"", "", ""};
}

TEST(BadInput, ASimulationWithoutFluidIsToldWhereItIsMissing) {
  const core::InputError error = errorOf(tank(""));
  EXPECT_EQ(error.fieldPath(), "simulation.fluids");
  EXPECT_THAT(error.what(), HasSubstr("tank.textproto:1:"));
}

TEST(BadInput, AFluidWithoutParticlesIsRefused) {
  EXPECT_EQ(errorOf(tank("fluids {}")).fieldPath(), "simulation.fluids[0]");
  const core::InputError none = errorOf(tank(block("count_x: 0")));
  EXPECT_EQ(none.fieldPath(), "simulation.fluids[0].blocks[0].count_x");
  EXPECT_THAT(none.what(), HasSubstr("tank.textproto:5:"));
}

// 10⁸ particles take about 56 GB.
TEST(BadInput, TooManyParticlesAreToldWhatTheyWouldTake) {
  const std::string text = tank(block("count_x: 500 count_y: 500 count_z: 400"));
  const v1::Scene scene = scene::parse(text, "tank.textproto");
  try {
    const FluidSimulation simulation(scene.simulation(), {.threads = 1, .availableMemory = 8'000'000'000});
    FAIL();
  } catch (const core::InputError& error) {
    EXPECT_EQ(error.fieldPath(), "simulation.fluids[0].blocks[0]");
    EXPECT_THAT(error.problem(), AllOf(StartsWith("the scene has at least 100000000 particles, about "),
                                       HasSubstr(" GB at "), HasSubstr("; 8 GB of free memory allows ")));
  }
}

TEST(BadInput, MoreParticlesThanAnOperatorAllowsAreNotBlamedOnMemory) {
  const core::InputError error = errorOf(tank(block("count_x: 20 count_y: 20 count_z: 20")), 1000);
  EXPECT_THAT(error.problem(), HasSubstr("the server's operator allows 1000"));
}

TEST(ParticleLimit, IsWhatMemoryHoldsOrAnOperatorAllowsOrCanBeNumbered) {
  Discretisation discretisation;
  discretisation.spacing = 0.05;
  discretisation.support = 0.1;
  const std::uint64_t each = bytesPerParticle(discretisation);
  EXPECT_EQ(particleLimit(discretisation, 1000 * each, 0).count, 800U);
  EXPECT_EQ(particleLimit(discretisation, 1000 * each, 900).count, 800U);
  EXPECT_EQ(particleLimit(discretisation, 1000 * each, 100).count, 100U);
  const ParticleLimit numbered = particleLimit(discretisation, std::uint64_t{1} << 50, 0);
  EXPECT_EQ(numbered.count, (std::uint64_t{1} << 31) - 1);
  EXPECT_EQ(numbered.reason, "their numbering allows");
}

}  // namespace
}  // namespace sluice::sim
