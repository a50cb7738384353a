// What is cut off, altered or made up: every reader answers with one InputError, in one line, or with particles.
#include <algorithm>
#include <limits>
#include <random>

#include "support.h"

namespace sluice::particleio::test {
namespace {

class Hostile : public testing::TestWithParam<Format> {};

/// Decodes; what is no InputError fails the test, or the process.
void expectParticlesOrInputError(const Bytes& bytes, Format format) {
  try {
    const ParticleFileData particles = decode(bytes, format, "file");
    for (const Eigen::Vector3f& position : particles.positions) ASSERT_TRUE(position.allFinite());
    // No reader makes more of a small file than it can hold: a particle takes a byte at the least.
    ASSERT_LE(particles.size(), std::max<std::size_t>(bytes.size(), 1) * 1100);
  } catch (const core::InputError& error) {
    const std::string message = error.what();
    ASSERT_TRUE(message.starts_with("file")) << message;
    ASSERT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST_P(Hostile, CutOffAtEveryLength) {
  const Bytes whole = encode(someParticles(), GetParam());
  const std::size_t particles = decode(whole, GetParam(), "file").size();
  std::size_t refused = 0;
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length));
    try {
      // Lines that are missing leave a shorter table; binary files say how many particles they have.
      EXPECT_LE(decode(cut, GetParam(), "file").size(), particles) << length;
    } catch (const core::InputError&) {
      ++refused;
    }
  }
  const bool text = GetParam() == Format::Xyz || GetParam() == Format::Csv;
  EXPECT_GT(refused, text ? 5 : whole.size() / 2);
}

TEST_P(Hostile, EveryByteChanged) {
  const Bytes whole = encode(someParticles(), GetParam());
  for (std::size_t i = 0; i < whole.size(); ++i) {
    for (const int value : {0x00, 0x7f, 0x80, 0xff, 0x39, 0x2d}) {
      Bytes changed = whole;
      changed[i] = static_cast<std::uint8_t>(value);
      expectParticlesOrInputError(changed, GetParam());
    }
  }
}

TEST_P(Hostile, RandomBytesAfterAGoodStart) {
  const Bytes whole = encode(someParticles(), GetParam());
  std::mt19937 random(1);
  for (int round = 0; round < 2000; ++round) {
    Bytes bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(random() % whole.size()));
    for (std::size_t extra = random() % 64; extra > 0; --extra) bytes.push_back(static_cast<std::uint8_t>(random()));
    expectParticlesOrInputError(bytes, GetParam());
  }
}

TEST_P(Hostile, PositionsThatAreNotFinite) {
  for (const float value : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    ParticleFileData particles = someParticles();
    particles.positions[1].y() = value;
    const std::string message = decodeError(encode(particles, GetParam()), GetParam());
    EXPECT_NE(message.find("the position of particle 1 is"), std::string::npos) << message;
  }
}

TEST_P(Hostile, WrongFormat) {
  const Bytes whole = encode(someParticles(), GetParam());
  for (const Format other : {Format::Bgeo, Format::Vtk, Format::Ply}) {
    const bool same = other == GetParam() || (other == Format::Bgeo && GetParam() == Format::BgeoGzip);
    if (same) continue;
    const std::string message = decodeError(whole, other);
    EXPECT_NE(message.find("is not a"), std::string::npos) << message;
  }
}

INSTANTIATE_TEST_SUITE_P(EveryFormat, Hostile, testing::ValuesIn(kFormats));

}  // namespace
}  // namespace sluice::particleio::test
