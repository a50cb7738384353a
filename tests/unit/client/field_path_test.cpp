#include "sluice/client/field_path.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sluice/client/failure.h"

namespace sluice::client {
namespace {

using ::testing::ElementsAre;

TEST(FieldPath, SplitsIntoNamesAndIndices) {
  EXPECT_THAT(parseFieldPath("title"), ElementsAre(PathStep{"title", {}}));
  EXPECT_THAT(
      parseFieldPath("simulation.fluids[0].blocks[12].count_x"),
      ElementsAre(PathStep{"simulation", {}}, PathStep{"fluids", 0}, PathStep{"blocks", 12}, PathStep{"count_x", {}}));
}

TEST(FieldPath, RefusesWhatIsNoPath) {
  for (const char* text : {"", ".", "a.", ".a", "a..b", "a[", "a[]", "a[x]", "a[-1]", "a[1", "a[1]b", "a[1][2]", "A",
                           "a b", "a[99999999999]"}) {
    EXPECT_THROW(parseFieldPath(text), UsageError) << text;
  }
}

}  // namespace
}  // namespace sluice::client
