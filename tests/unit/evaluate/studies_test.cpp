#include "sluice/evaluate/study.h"

#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "features/gates.h"
#include "sluice/core/input_error.h"
#include "sluice/scene/scene.h"

namespace sluice::evaluate {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::string refusal(std::string_view name, std::string_view only) {
  try {
    findStudies(name, only);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Studies, AreFoundByName) {
  std::set<std::string_view> names;
  for (const Study& study : studies()) {
    EXPECT_TRUE(names.insert(study.name).second) << study.name;
    EXPECT_FALSE(study.doc.empty());
    ASSERT_EQ(findStudies(study.name, "").size(), 1U);
    for (const std::string& part : study.parts()) EXPECT_EQ(findStudies(study.name, part).size(), 1U) << part;
  }
  EXPECT_EQ(findStudies("all", "").size(), studies().size());
}

TEST(Studies, UnknownNamesAreRefusedWithThoseThereAre) {
  EXPECT_THAT(refusal("smothing", ""), AllOf(HasSubstr("smothing"), HasSubstr("smoothing"), HasSubstr("stability")));
  EXPECT_THAT(refusal("smoothing", "spere"), AllOf(HasSubstr("--only"), HasSubstr("spere"), HasSubstr("sphere")));
  EXPECT_EQ(refusal("all", "sphere"), "");
}

TEST(Gates, NameFieldsOfTheSchema) {
  for (const Gate& gate : gates()) {
    for (const std::string_view side : {gate.inUse, gate.leftOut}) {
      v1::Scene scene = scene::loadShipped("column_and_sheet");
      EXPECT_NO_THROW(scene::assign(scene, assignmentsOf(gate.both))) << gate.feature;
      EXPECT_NO_THROW(scene::assign(scene, assignmentsOf(side))) << gate.feature;
    }
  }
}

}  // namespace
}  // namespace sluice::evaluate
