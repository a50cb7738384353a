#include <bit>

#include <gmock/gmock.h>

#include "support.h"

namespace sluice::particleio::test {
namespace {

using namespace std::string_literals;
using testing::HasSubstr;

/// Big-endian, as everything in the format.
std::string int32(std::uint32_t value) {
  return {static_cast<char>(value >> 24U), static_cast<char>(value >> 16U), static_cast<char>(value >> 8U),
          static_cast<char>(value)};
}
std::string int16(std::uint16_t value) { return {static_cast<char>(value >> 8U), static_cast<char>(value)}; }
std::string float32(float value) { return int32(std::bit_cast<std::uint32_t>(value)); }

std::string header(std::uint32_t points, std::uint32_t attributes, std::uint32_t version = 5) {
  std::string text = "BgeoV" + int32(version) + int32(points);
  for (int i = 0; i < 3; ++i) text += int32(0);
  text += int32(attributes);
  for (int i = 0; i < 3; ++i) text += int32(0);
  return text;
}

std::string attribute(const std::string& name, std::uint16_t size, std::uint32_t type) {
  std::string text = int16(static_cast<std::uint16_t>(name.size())) + name + int16(size) + int32(type);
  for (int i = 0; i < size; ++i) text += int32(0);
  return text;
}

TEST(Bgeo, TakesWhatItKnowsAndSkipsTheRest) {
  std::string file = header(1, 4) + attribute("pscale", 1, 0) + attribute("velocity", 3, 0);
  file += int16(4) + "name"s + int16(1) + int32(4) + int32(2) + int16(3) + "abc"s + int16(0);  // indexed text
  file += attribute("pid", 1, 1);
  file += float32(1) + float32(2) + float32(3) + float32(1);
  file += float32(0.5F) + float32(4) + float32(5) + float32(6) + int32(0) + int32(42);
  const ParticleFileData particles = decodeString(file, Format::Bgeo);
  ASSERT_EQ(particles.size(), 1U);
  EXPECT_EQ(particles.positions[0], Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(particles.velocities[0], Eigen::Vector3f(4, 5, 6));
  EXPECT_EQ(particles.ids[0], 42U);
  EXPECT_TRUE(particles.densities.empty());
}

TEST(Bgeo, RefusesCountsThatLie) {
  EXPECT_THAT(decodeError(header(0x7fffffff, 0), Format::Bgeo), HasSubstr("the points needs 34359738352 bytes, 0 are"));
  EXPECT_THAT(decodeError(header(0xffffffff, 0), Format::Bgeo), HasSubstr("negative"));
  EXPECT_THAT(decodeError(header(0, 0x7fffffff), Format::Bgeo), HasSubstr("cut off"));
  EXPECT_THAT(decodeError(header(1, 1) + attribute("v", 0, 9), Format::Bgeo), HasSubstr("has type 9"));
}

TEST(Bgeo, RefusesOtherVersions) { EXPECT_THAT(decodeError(header(0, 0, 4), Format::Bgeo), HasSubstr("version 4")); }

TEST(Bgeo, RefusesDamagedGzip) {
  Bytes bytes = encode(someParticles(), Format::BgeoGzip);
  bytes[bytes.size() / 2] ^= 0xffU;
  EXPECT_THAT(decodeError(bytes, Format::Bgeo), HasSubstr("gzip data is"));
}

TEST(Bgeo, NamesTheByteWhereAFileEnds) {
  Bytes bytes = encode(someParticles(), Format::Bgeo);
  bytes.resize(30);
  EXPECT_THAT(decodeError(bytes, Format::Bgeo), HasSubstr("file: at byte "));
}

}  // namespace
}  // namespace sluice::particleio::test
