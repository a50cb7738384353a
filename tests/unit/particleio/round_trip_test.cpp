#include <bit>
#include <cmath>
#include <random>

#include "support.h"

namespace sluice::particleio::test {
namespace {

class RoundTrip : public testing::TestWithParam<Format> {};

void expectEqual(const ParticleFileData& actual, const ParticleFileData& expected) {
  EXPECT_EQ(actual.positions, expected.positions);
  EXPECT_EQ(actual.velocities, expected.velocities);
  EXPECT_EQ(actual.densities, expected.densities);
  EXPECT_EQ(actual.ids, expected.ids);
  EXPECT_EQ(actual.pressures, expected.pressures);
  EXPECT_EQ(actual.fluids, expected.fluids);
}

TEST_P(RoundTrip, KeepsEveryNumberExactly) {
  ParticleFileData expected = someParticles();
  const ParticleFileData actual = decode(encode(expected, GetParam()), GetParam(), "file");
  if (GetParam() == Format::Xyz) expected = {expected.positions, {}, {}, {}};
  expectEqual(actual, expected);
}

TEST_P(RoundTrip, KeepsTheBitsOfAnyFloats) {
  std::mt19937 random(1);
  const auto anyFloat = [&] {
    while (true) {
      const float value = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
      if (std::isfinite(value)) return value;
    }
  };
  ParticleFileData expected{{{-0.0F, 0.0F, std::numeric_limits<float>::denorm_min()}}, {}, {}, {}};
  for (int i = 0; i < 20000; ++i) expected.positions.emplace_back(anyFloat(), anyFloat(), anyFloat());
  const ParticleFileData actual = decode(encode(expected, GetParam()), GetParam(), "file");
  ASSERT_EQ(actual.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      ASSERT_EQ(std::bit_cast<std::uint32_t>(actual.positions[i][axis]),
                std::bit_cast<std::uint32_t>(expected.positions[i][axis]))
          << expected.positions[i][axis];
    }
  }
}

TEST_P(RoundTrip, LeavesOutPressuresThatAreNotFinite) {
  ParticleFileData particles = someParticles();
  particles.pressures[1] = std::numeric_limits<float>::quiet_NaN();
  const ParticleFileData actual = decode(encode(particles, GetParam()), GetParam(), "file");
  EXPECT_EQ(actual.size(), particles.size());
  EXPECT_TRUE(actual.pressures.empty());
}

TEST_P(RoundTrip, KeepsPositionsAlone) {
  const ParticleFileData expected{someParticles().positions, {}, {}, {}};
  expectEqual(decode(encode(expected, GetParam()), GetParam(), "file"), expected);
}

TEST_P(RoundTrip, KeepsNoParticles) { EXPECT_EQ(decode(encode({}, GetParam()), GetParam(), "file").size(), 0U); }

INSTANTIATE_TEST_SUITE_P(EveryFormat, RoundTrip, testing::ValuesIn(kFormats));

}  // namespace
}  // namespace sluice::particleio::test
