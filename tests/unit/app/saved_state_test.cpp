#include "sluice/app/saved_state.h"

#include <cstring>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include "sluice/core/input_error.h"
#include "sluice/scene/scene.h"

namespace sluice::app {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;
using Bytes = std::vector<std::uint8_t>;

/// A small splash with foam.
v1::Scene splash() {
  return scene::parse(R"(
    seed: 7
    simulation {
      particle_spacing: 0.05
      container { min { x: 0 y: 0 z: 0 } max { x: 1.2 y: 1 z: 0.5 } }
      fluids { blocks { first_particle { x: 0.05 y: 0.05 z: 0.05 } count_x: 8 count_y: 14 count_z: 9 } }
    }
    foam { trapped_air: 100 wave_crests: 100 max_particles: 1000 })",
                      "splash");
}

void advance(core::ParticleSource& source, int steps) {
  for (int step = 0; step < steps; ++step) ASSERT_TRUE(source.advance()) << source.halted();
}

std::string refusal(const Bytes& bytes) {
  try {
    decodeState(bytes, "run.state", 1);
  } catch (const core::InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << "was taken";
  return {};
}

class SavedState : public testing::Test {
 protected:
  SavedState() : scene_(splash()), source_(openSource(scene_, 1)) {
    advance(*source_, 90);
    bytes_ = encodeState(scene_, *source_);
  }

  v1::Scene scene_;
  std::unique_ptr<core::ParticleSource> source_;
  Bytes bytes_;
};

TEST_F(SavedState, HoldsSceneParticlesAndFoam) {
  const ResumedRun run = decodeState(bytes_, "run.state", 1);
  EXPECT_EQ(run.live.scene.SerializeAsString(), scene_.SerializeAsString());
  EXPECT_EQ(encodeState(run.live.scene, *run.source), bytes_);
  advance(*source_, 60);
  advance(*run.source, 60);
  const auto expected = source_->snapshot();
  const auto actual = run.source->snapshot();
  EXPECT_EQ(actual->time, expected->time);
  EXPECT_EQ(actual->positions, expected->positions);
  EXPECT_EQ(actual->velocities, expected->velocities);
  EXPECT_EQ(actual->ids, expected->ids);
  ASSERT_GT(expected->diffuse.size(), 0U) << "no foam was made that could differ";
  EXPECT_EQ(actual->diffuse.positions, expected->diffuse.positions);
  EXPECT_EQ(actual->diffuse.ids, expected->diffuse.ids);
  EXPECT_EQ(actual->diffuse.remaining, expected->diffuse.remaining);
}

TEST_F(SavedState, IsRefusedWhenCutOffAtEverySixteenth) {
  for (std::size_t part = 0; part < 16; ++part) {
    const Bytes cut(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(bytes_.size() * part / 16));
    EXPECT_THAT(refusal(cut), part == 0 ? HasSubstr("is no saved state") : HasSubstr("cut off")) << part;
  }
  const Bytes oneShort(bytes_.begin(), bytes_.end() - 1);
  EXPECT_THAT(refusal(oneShort), HasSubstr("cut off"));
  // Everything that is shorter than the head.
  for (std::ptrdiff_t length = 1; length < 24; ++length) {
    EXPECT_THAT(refusal(Bytes(bytes_.begin(), bytes_.begin() + length)), HasSubstr("cut off"));
  }
}

TEST_F(SavedState, IsRefusedWhenAnyByteIsDifferent) {
  std::mt19937 random(1);
  for (int round = 0; round < 400; ++round) {
    Bytes damaged = bytes_;
    // The head at every byte, the rest at random ones.
    const std::size_t at = round < 24 ? static_cast<std::size_t>(round) : random() % damaged.size();
    damaged[at] ^= static_cast<std::uint8_t>(1 + random() % 255);
    EXPECT_THAT(refusal(damaged), StartsWith("run.state: "));
  }
  Bytes longer = bytes_;
  longer.push_back(0);
  EXPECT_THAT(refusal(longer), HasSubstr("damaged"));
}

TEST_F(SavedState, IsRefusedWhenForeignOrOfAnotherVersion) {
  const std::string text = "ply\nformat ascii 1.0\n";
  EXPECT_THAT(refusal(Bytes(text.begin(), text.end())), HasSubstr("is no saved state"));
  const auto withVersion = [&](std::uint32_t version) {
    Bytes other = bytes_;
    std::memcpy(&other[8], &version, sizeof version);
    const std::size_t end = other.size() - sizeof(std::uint32_t);
    const auto checksum = static_cast<std::uint32_t>(crc32_z(0, other.data(), end));
    std::memcpy(&other[end], &checksum, sizeof checksum);
    return other;
  };
  EXPECT_THAT(refusal(withVersion(3)), HasSubstr("has version 3; this program reads version 2"));
  EXPECT_THAT(refusal(withVersion(1)), HasSubstr("has version 1, of an older program"));
}

TEST_F(SavedState, IsOfSimulationsAlone) {
  const v1::Scene sheet = scene::parse("column_and_sheet {}", "sheet");
  EXPECT_THROW(encodeState(sheet, *openSource(sheet, 1)), core::InputError);
}

}  // namespace
}  // namespace sluice::app
