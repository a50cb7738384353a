#include <gmock/gmock.h>

#include "support.h"

namespace sluice::particleio::test {
namespace {

using namespace std::string_literals;
using testing::HasSubstr;

TEST(Ply, ReadsAscii) {
  const ParticleFileData particles = decodeString(
      "ply\r\nformat ascii 1.0\r\ncomment made by hand\r\nelement vertex 2\r\nproperty double x\r\n"
      "property double y\r\nproperty double z\r\nproperty uchar red\r\nproperty float Velocity_y\r\n"
      "element face 1\r\nproperty list uchar int vertex_index\r\nend_header\r\n1 2 3 255 4\r\n5 6 7 0 8\r\n3 0 1 0\r\n",
      Format::Ply);
  EXPECT_EQ(particles.positions[1], Eigen::Vector3f(5, 6, 7));
  EXPECT_EQ(particles.velocities[1], Eigen::Vector3f(0, 8, 0));
}

TEST(Ply, ReadsBigEndianAndPassesOverElementsBefore) {
  const std::string file =
      "ply\nformat binary_big_endian 1.0\nelement face 2\nproperty list uchar short vertex_index\nproperty uchar flag\n"
      "element vertex 1\nproperty float x\nproperty float y\nproperty float z\nproperty list uchar float w\n"
      "property ushort id\nend_header\n"
      "\x01\x00\x07\x09"                                                // a list of one, a flag
      "\x00\x09"s                                                       // an empty list, a flag
      "\x3f\x80\x00\x00\x40\x00\x00\x00\x40\x40\x00\x00\x00\x01\x02"s;  // 1 2 3, an empty list, 258
  const ParticleFileData particles = decodeString(file, Format::Ply);
  EXPECT_EQ(particles.positions[0], Eigen::Vector3f(1, 2, 3));
  EXPECT_THAT(particles.ids, testing::ElementsAre(258U));
}

std::string asciiHead(const std::string& count) {
  return "ply\nformat ascii 1.0\nelement vertex " + count +
         "\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
}

TEST(Ply, RefusesCountsThatLie) {
  EXPECT_THAT(decodeError(asciiHead("18446744073709551615") + "1 2 3\n", Format::Ply), HasSubstr("cut off"));
  EXPECT_THAT(decodeError(asciiHead("2") + "1 2 3\n", Format::Ply), HasSubstr("cut off"));
  EXPECT_THAT(decodeError(asciiHead("-2") + "1 2 3\n", Format::Ply), HasSubstr("\"-2\" is not a count"));
}

TEST(Ply, RefusesHeadersThatMakeNoSense) {
  EXPECT_THAT(decodeError("ply\nformat ascii 1.0\n", Format::Ply), HasSubstr("end_header is missing"));
  EXPECT_THAT(decodeError("ply\nend_header\n", Format::Ply), HasSubstr("no line \"format\""));
  EXPECT_THAT(decodeError("ply\nformat ebcdic 1.0\nend_header\n", Format::Ply), HasSubstr("known are ascii"));
  EXPECT_THAT(decodeError("ply\nformat ascii 1.0\nend_header\n", Format::Ply), HasSubstr("no element \"vertex\""));
  EXPECT_THAT(decodeError("ply\nproperty float x\n", Format::Ply), HasSubstr("before any element"));
  EXPECT_THAT(decodeError("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n", Format::Ply),
              HasSubstr("lacks one of x, y, z"));
}

TEST(Ply, LeavesOutIdsThatAreNotWhole) {
  const ParticleFileData particles = decodeString(
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
      "property float id\nend_header\n1 2 3 0.5\n",
      Format::Ply);
  EXPECT_TRUE(particles.ids.empty());
}

}  // namespace
}  // namespace sluice::particleio::test
