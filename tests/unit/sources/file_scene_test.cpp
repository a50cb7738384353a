#include <gmock/gmock.h>

#include "sluice/core/camera.h"
#include "sluice/scene/convert.h"
#include "support.h"

namespace sluice::sources::test {
namespace {

using testing::HasSubstr;

using FileScene = WithFolder;

TEST_F(FileScene, MeasuresFramesAndStandsOnAFloor) {
  for (int number = 1; number <= 5; ++number) writeFrame(number);
  const v1::Scene scene = sceneForParticleFile(path("frame_####.bgeo"));
  EXPECT_NO_THROW(scene::validate(scene));
  EXPECT_NEAR(scene.particle_file().particle_spacing(), 0.1, 1e-6);
  EXPECT_NEAR(scene.background().floor_height(), -0.1, 1e-6);
  EXPECT_NEAR(scene.background().tile_size(), 0.5, 1e-9) << "about an eighth of 4.3 m";
  const Eigen::Vector3d target = scene::toVector(scene.camera().target());
  EXPECT_NEAR(target.x(), 3.15, 1e-5) << "in the middle of the way from the first frame to the last";
}

TEST_F(FileScene, HoldsEveryParticleInThePicture) {
  const v1::Scene scene = sceneForParticleFile(writeFrame(0).string());
  const core::Camera camera = scene::toCamera(scene.camera());
  const core::ViewBasis basis = core::viewBasis(camera);
  for (const Eigen::Vector3f& position : lattice(4, 0.1F).positions) {
    const Eigen::Vector3f ray = position - camera.eye;
    const float depth = ray.dot(basis.forward);
    ASSERT_GT(depth, 0);
    EXPECT_LT(std::abs(ray.dot(basis.up) / depth), std::tan(0.5 * 45 * 3.14159265 / 180));
  }
}

TEST_F(FileScene, TakesDegenerateFiles) {
  const std::vector<std::vector<Eigen::Vector3f>> clouds{{},
                                                         {{1, 2, 3}},
                                                         std::vector<Eigen::Vector3f>(50, {1, 2, 3}),
                                                         {{0, 0, 0}, {0, 5000, 0}},
                                                         {{0, 0, 0}, {1e-30F, 0, 0}}};
  for (const auto& positions : clouds) {
    particleio::writeParticleFile(path("cloud.ply"), {positions, {}, {}, {}});
    const v1::Scene scene = sceneForParticleFile(path("cloud.ply"));
    EXPECT_NO_THROW(scene::validate(scene));
    EXPECT_GT(openParticlePlayback(scene)->snapshot()->spacing, 0);
  }
}

TEST_F(FileScene, RefusesParticlesOutOfEveryCamerasReach) {
  particleio::writeParticleFile(path("far.ply"), {{{0, 0, 0}, {3e7F, 0, 0}}, {}, {}, {}});
  try {
    sceneForParticleFile(path("far.ply"));
    FAIL() << "was taken";
  } catch (const core::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("far.ply: the particles reach from (0, 0, 0) to (3e+07, 0, 0)"));
  }
}

TEST(IsParticleFile, GoesByTheEnding) {
  for (const char* name : {"a.bgeo", "a.BGEO", "a.bgeo.gz", "a.vtk", "b/frame_####.ply", "a.xyz", "a.csv"}) {
    EXPECT_TRUE(isParticleFile(name)) << name;
  }
  for (const char* name : {"dam_break", "a.textproto", "a.vtu", "bgeo", ""}) EXPECT_FALSE(isParticleFile(name)) << name;
}

}  // namespace
}  // namespace sluice::sources::test
