#include <fstream>

#include <gmock/gmock.h>

#include "support.h"

namespace sluice::sources::test {
namespace {

using testing::HasSubstr;

class Playback : public WithFolder {
 protected:
  static float x(const core::ParticleSource& source) { return source.snapshot()->positions.front().x(); }
};

TEST_F(Playback, OfASingleFileStandsStill) {
  const auto source = openParticlePlayback(sceneOf(writeFrame(7).string()));
  EXPECT_FALSE(source->advance());
  EXPECT_EQ(source->time(), 0);
  EXPECT_TRUE(source->halted().empty());
  const auto snapshot = source->snapshot();
  EXPECT_EQ(snapshot->size(), 64U);
  EXPECT_EQ(snapshot->bounds.min().x(), 7);
  EXPECT_NEAR(snapshot->spacing, 0.1, 1e-6);
  EXPECT_EQ(source->plan().leftOut.front().name, "read frame");
}

TEST_F(Playback, GoesThroughASequenceInTheOrderOfItsNumbers) {
  for (const int number : {10, 8, 9, 11}) writeFrame(number, 1);
  v1::Scene scene = sceneOf(path("frame_#.bgeo"));
  scene.mutable_particle_file()->set_loop(false);
  scene.mutable_particle_file()->set_frames_per_second(10);
  const auto source = openParticlePlayback(scene);
  EXPECT_EQ(x(*source), 8);
  for (const float expected : {9.0F, 10.0F, 11.0F}) {
    EXPECT_TRUE(source->advance());
    EXPECT_EQ(x(*source), expected);
  }
  EXPECT_FALSE(source->advance());
  EXPECT_EQ(x(*source), 11);
  EXPECT_NEAR(source->time(), 0.3, 1e-12);
}

TEST_F(Playback, LoopsWithoutTurningTimeBack) {
  for (int number = 1; number <= 3; ++number) writeFrame(number);
  const auto source = openParticlePlayback(sceneOf(path("frame_####.bgeo")));
  double time = 0;
  for (const float expected : {2.0F, 3.0F, 1.0F, 2.0F}) {
    ASSERT_TRUE(source->advance());
    EXPECT_EQ(x(*source), expected);
    EXPECT_GT(source->time(), time);
    time = source->time();
  }
  source->reset();
  EXPECT_EQ(x(*source), 1);
  EXPECT_EQ(source->time(), 0);
}

TEST_F(Playback, TakesLiveSettingsOver) {
  for (int number = 1; number <= 3; ++number) writeFrame(number);
  v1::Scene scene = sceneOf(path("frame_####.bgeo"));
  const auto source = openParticlePlayback(scene);
  scene.mutable_particle_file()->set_frames_per_second(2);
  scene.mutable_particle_file()->set_loop(false);
  source->update(scene);
  EXPECT_TRUE(source->advance());
  EXPECT_EQ(source->time(), 0.5);
  EXPECT_TRUE(source->advance());
  EXPECT_FALSE(source->advance());
}

TEST_F(Playback, KeepsTheLastGoodFrameBeforeADamagedOne) {
  for (int number = 1; number <= 4; ++number) writeFrame(number);
  std::ofstream(path("frame_0003.bgeo"), std::ios::binary) << "BgeoV";
  const auto source = openParticlePlayback(sceneOf(path("frame_####.bgeo")));
  EXPECT_TRUE(source->advance());
  EXPECT_FALSE(source->advance());
  EXPECT_THAT(source->halted(), HasSubstr("frame_0003.bgeo: at byte 5: the file is cut off"));
  EXPECT_EQ(x(*source), 2);
  EXPECT_FALSE(source->advance()) << "stays halted";
  source->reset();
  EXPECT_TRUE(source->halted().empty());
  EXPECT_EQ(x(*source), 1);
}

TEST_F(Playback, HaltsWhereAFrameHasVanished) {
  for (int number = 1; number <= 2; ++number) writeFrame(number);
  const auto source = openParticlePlayback(sceneOf(path("frame_####.bgeo")));
  std::filesystem::remove(path("frame_0002.bgeo"));
  EXPECT_FALSE(source->advance());
  EXPECT_THAT(source->halted(), HasSubstr("no such file"));
}

TEST_F(Playback, NamesTheFirstMissingFrame) {
  for (const int number : {1, 2, 5}) writeFrame(number);
  EXPECT_THAT(openError(path("frame_####.bgeo")),
              HasSubstr("a gap: frame_0003.bgeo is missing, frame_0001.bgeo to frame_0005.bgeo are expected"));
}

TEST_F(Playback, RefusesPatternsThatNoFileMatches) {
  writeFrame(1);
  EXPECT_THAT(openError(path("other_####.bgeo")), HasSubstr("no file has such a name, like other_0001.bgeo"));
  EXPECT_THAT(openError(path("frame_######.bgeo")), HasSubstr("frame_000001.bgeo"));
  EXPECT_THAT(openError(path("f#ame_####.bgeo")), HasSubstr("two runs"));
  EXPECT_THAT(openError(path("none/frame_####.bgeo")), HasSubstr("no folder"));
  EXPECT_THAT(openError(path("frame_0009.bgeo")), HasSubstr("no such file"));
}

TEST_F(Playback, UsesTheSpacingThatTheSceneGives) {
  v1::Scene scene = sceneOf(writeFrame(1).string());
  scene.mutable_particle_file()->set_particle_spacing(0.25);
  EXPECT_EQ(openParticlePlayback(scene)->snapshot()->spacing, 0.25);
}

TEST_F(Playback, ShowsFilesWithoutParticles) {
  particleio::writeParticleFile(path("empty.ply"), {});
  const auto source = openParticlePlayback(sceneOf(path("empty.ply")));
  EXPECT_EQ(source->snapshot()->size(), 0U);
  EXPECT_GT(source->snapshot()->spacing, 0);
}

}  // namespace
}  // namespace sluice::sources::test
