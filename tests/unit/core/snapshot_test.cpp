#include <gtest/gtest.h>

#include "sluice/core/particle_snapshot.h"

namespace sluice::core {
namespace {

TEST(Bounds, HoldEveryPointTightly) {
  const Eigen::AlignedBox3f bounds = boundsOf({{1, -2, 3}, {-4, 5, 0}, {0, 0, 9}});
  EXPECT_EQ(bounds.min(), Eigen::Vector3f(-4, -2, 0));
  EXPECT_EQ(bounds.max(), Eigen::Vector3f(1, 5, 9));
}

TEST(Bounds, OfNothingAreEmpty) { EXPECT_TRUE(boundsOf({}).isEmpty()); }

}  // namespace
}  // namespace sluice::core
