#include "sluice/sources/column_and_sheet.h"

#include <cmath>

#include "support.h"

namespace sluice::sources::test {
namespace {

TEST(ColumnAndSheet, FillsItsVolumeAtItsSpacing) {
  for (const std::size_t n : {1000U, 64000U}) {
    const auto spacing = static_cast<float>(std::cbrt(0.55 / static_cast<double>(n)));
    const std::vector<Eigen::Vector3f> positions = columnAndSheet(n, 1);
    ASSERT_EQ(positions.size(), n);
    std::size_t inSheet = 0;
    float top = 0;
    for (const Eigen::Vector3f& p : positions) {
      ASSERT_TRUE(p.x() > 0 && p.x() < 2 + spacing && p.y() > 0 && p.z() > 0 && p.z() < 1 + spacing) << p.transpose();
      if (p.x() > 0.5F + 0.2F * spacing) {
        inSheet += p.y() < 0.1F + spacing ? 1 : 0;
      } else {
        top = std::max(top, p.y());
      }
    }
    // The sheet holds 0.15 of 0.55 m³, to within the layers that a lattice rounds to; the rest stands 0.8 m high.
    EXPECT_NEAR(static_cast<double>(inSheet) / static_cast<double>(n), 0.15 / 0.55, 0.1);
    EXPECT_NEAR(top, 0.8, 0.1);
  }
}

TEST(ColumnAndSheet, MovesEveryParticleByLittle) {
  const auto spacing = static_cast<float>(std::cbrt(0.55 / 64000));
  for (const Eigen::Vector3f& p : columnAndSheet(64000, 3)) {
    // Heights stand at 0.5, 1.5, … spacings before they are moved.
    const float inLayers = p.y() / spacing - 0.5F;
    ASSERT_LE(std::abs(inLayers - std::round(inLayers)), 0.1501F);
  }
}

TEST(ColumnAndSheet, DependsOnItsSeedAlone) {
  EXPECT_EQ(columnAndSheet(500, 1), columnAndSheet(500, 1));
  EXPECT_NE(columnAndSheet(500, 1), columnAndSheet(500, 2));
}

TEST(ColumnAndSheet, IsASourceAtRest) {
  const auto source = openColumnAndSheet(scene::loadShipped("column_and_sheet"));
  EXPECT_FALSE(source->advance());
  const auto snapshot = source->snapshot();
  EXPECT_EQ(snapshot->size(), 64000U);
  EXPECT_NEAR(snapshot->spacing, 0.020484, 1e-6);
  EXPECT_FALSE(snapshot->bounds.isEmpty());
}

TEST(ColumnAndSheet, TakesAnyNumberOfParticles) {
  for (const std::size_t n : {0U, 1U, 2U, 7U}) EXPECT_EQ(columnAndSheet(n, 1).size(), n);
}

}  // namespace
}  // namespace sluice::sources::test
