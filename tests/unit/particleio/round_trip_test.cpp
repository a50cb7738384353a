#include "support.h"

namespace sluice::particleio::test {
namespace {

class RoundTrip : public testing::TestWithParam<Format> {};

void expectEqual(const ParticleFileData& actual, const ParticleFileData& expected) {
  EXPECT_EQ(actual.positions, expected.positions);
  EXPECT_EQ(actual.velocities, expected.velocities);
  EXPECT_EQ(actual.densities, expected.densities);
  EXPECT_EQ(actual.ids, expected.ids);
}

TEST_P(RoundTrip, KeepsEveryNumberExactly) {
  ParticleFileData expected = someParticles();
  const ParticleFileData actual = decode(encode(expected, GetParam()), GetParam(), "file");
  if (GetParam() == Format::Xyz) expected = {expected.positions, {}, {}, {}};
  expectEqual(actual, expected);
}

TEST_P(RoundTrip, KeepsPositionsAlone) {
  const ParticleFileData expected{someParticles().positions, {}, {}, {}};
  expectEqual(decode(encode(expected, GetParam()), GetParam(), "file"), expected);
}

TEST_P(RoundTrip, KeepsNoParticles) { EXPECT_EQ(decode(encode({}, GetParam()), GetParam(), "file").size(), 0U); }

INSTANTIATE_TEST_SUITE_P(EveryFormat, RoundTrip, testing::ValuesIn(kFormats));

}  // namespace
}  // namespace sluice::particleio::test
