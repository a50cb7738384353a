#include "sluice/scene/parameters.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

namespace sluice::scene::test {
namespace {

Parameter find(const std::string& path) {
  const std::vector<Parameter> all = parameters();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Parameter& p) { return p.path == path; });
  if (found == all.end()) {
    ADD_FAILURE() << path << " is not listed";
    return {};
  }
  return *found;
}

TEST(Parameters, CarryTheirAnnotations) {
  const Parameter viscosity = find("simulation.fluids[0].viscosity");
  EXPECT_EQ(viscosity.type, "number");
  EXPECT_EQ(viscosity.defaultValue, "0.01");
  EXPECT_EQ(viscosity.info.unit(), "m²/s");
  EXPECT_EQ(viscosity.info.max(), 100);
  EXPECT_EQ(viscosity.info.apply(), v1::LIVE);
  EXPECT_EQ(find("simulation.gravity").defaultValue, "0,-9.81,0");
  EXPECT_EQ(find("look.liquid.colour").type, "colour");
  EXPECT_EQ(find("simulation.dfsph.max_iterations").type, "whole number");
}

TEST(Parameters, NameTheirChoice) {
  EXPECT_EQ(find("look.smoothing.curvature_flow").choiceOf, "look.smoothing.method");
  EXPECT_EQ(find("particle_file").choiceOf, "source");
  EXPECT_TRUE(find("simulation").chosenByDefault);
  EXPECT_FALSE(find("particle_file").chosenByDefault);
}

TEST(Parameters, LeaveNeitherBarsNorBreaksInTheTable) {
  for (const Parameter& parameter : parameters()) {
    EXPECT_EQ(parameter.info.doc().find_first_of("|\n"), std::string::npos) << parameter.path;
  }
}

TEST(Parameters, ReferencePageIsUpToDate) {
  const char* root = std::getenv("SLUICE_SOURCE_DIR");
  ASSERT_NE(root, nullptr) << "run by ctest, which sets SLUICE_SOURCE_DIR";
  const std::string file = std::string(root) + "/docs/parameters.md";
  if (std::getenv("UPDATE") != nullptr) std::ofstream(file) << parameterReferenceMarkdown();
  std::ifstream stream(file);
  const std::string page{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  EXPECT_EQ(page, parameterReferenceMarkdown()) << "write it anew: UPDATE=1 ctest -R Parameters.ReferencePage";
}

}  // namespace
}  // namespace sluice::scene::test
