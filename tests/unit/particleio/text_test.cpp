#include <gmock/gmock.h>

#include "support.h"

namespace sluice::particleio::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(Text, TakesEverySeparator) {
  for (const std::string separator : {",", ";", "\t", " ", ", ", "  \t"}) {
    const std::string line = "1" + separator + "-2.5" + separator + "+3e-1";
    const ParticleFileData particles = decodeString(line + "\n" + line + "\r\n", Format::Csv);
    EXPECT_THAT(particles.positions, ElementsAre(Eigen::Vector3f(1, -2.5F, 0.3F), Eigen::Vector3f(1, -2.5F, 0.3F)))
        << separator;
  }
}

TEST(Text, FindsColumnsByTheirNames) {
  const ParticleFileData particles = decodeString(
      "\"id\",\"velocity:0\",\"velocity:1\",\"velocity:2\",\"pressure\",\"Points:0\",\"Points:1\",\"Points:2\"\n"
      "5,1,2,3,99,4,5,6\n",
      Format::Csv);
  EXPECT_EQ(particles.positions[0], Eigen::Vector3f(4, 5, 6));
  EXPECT_EQ(particles.velocities[0], Eigen::Vector3f(1, 2, 3));
  EXPECT_THAT(particles.ids, ElementsAre(5U));
}

TEST(Text, TakesTheFirstThreeColumnsWithoutNames) {
  const ParticleFileData particles = decodeString("# a comment\n\n1 2 3 0 0 1\n4 5 6 0 0 1", Format::Xyz);
  EXPECT_THAT(particles.positions, ElementsAre(Eigen::Vector3f(1, 2, 3), Eigen::Vector3f(4, 5, 6)));
  EXPECT_TRUE(particles.velocities.empty());
}

TEST(Text, PassesOverAByteOrderMark) { EXPECT_EQ(decodeString("\xef\xbb\xbfx,y,z\n1,2,3\n", Format::Csv).size(), 1U); }

TEST(Text, TakesTheHeadOfChemistsFiles) {
  EXPECT_THAT(decodeString("2\ntwo atoms\nH 1 2 3\nO 4 5 6\n", Format::Xyz).positions,
              ElementsAre(Eigen::Vector3f(1, 2, 3), Eigen::Vector3f(4, 5, 6)));
  EXPECT_EQ(decodeString("1\n\n1 2 3\n", Format::Xyz).size(), 1U);
  EXPECT_THAT(decodeError("5\ncomment\n1 2 3\n", Format::Xyz), HasSubstr("file:1: promises 5 particles"));
}

TEST(Text, NamesTheLine) {
  EXPECT_THAT(decodeError("1,2,3\n\n4,5\n", Format::Csv), HasSubstr("file:3: has 2 columns; 3 are needed"));
  EXPECT_THAT(decodeError("1,2,3\n4,5,six\n", Format::Csv), HasSubstr("file:2: \"six\" in column 3 is not a number"));
  EXPECT_THAT(decodeError("time,pressure\n1,2\n", Format::Csv), HasSubstr("file:1: names no columns x, y, z"));
}

TEST(Text, RefusesBinary) {
  EXPECT_THAT(decodeError(std::string("1 2 3\n\0", 7), Format::Xyz), HasSubstr("is not a text file"));
}

}  // namespace
}  // namespace sluice::particleio::test
