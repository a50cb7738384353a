#include "sluice/core/input_error.h"

#include <gtest/gtest.h>

namespace sluice::core {
namespace {

TEST(InputError, JoinsThePartsThatThereAre) {
  EXPECT_STREQ(InputError("a.textproto:1:2", "look.time", "-1 is outside [0, 50]").what(),
               "a.textproto:1:2: look.time: -1 is outside [0, 50]");
  EXPECT_STREQ(InputError("", "look.time", "bad").what(), "look.time: bad");
  EXPECT_STREQ(InputError("a.ply", "", "bad").what(), "a.ply: bad");
  EXPECT_STREQ(InputError("", "", "bad").what(), "bad");
}

TEST(InputError, KeepsItsParts) {
  const InputError error("where", "field", "problem");
  EXPECT_EQ(error.where(), "where");
  EXPECT_EQ(error.fieldPath(), "field");
  EXPECT_EQ(error.problem(), "problem");
}

}  // namespace
}  // namespace sluice::core
