// Cameras and clouds that break careless renderers: no GL error, nothing that is not finite, the same picture twice.
#include "camera_cases.h"
#include "render_test.h"
#include "sluice/core/input_error.h"

namespace sluice::testing {
namespace {

class CameraCases : public RenderTest, public ::testing::WithParamInterface<CameraCase> {};

TEST_P(CameraCases, GivesAFiniteAndRepeatablePicture) {
  const CameraCase& c = GetParam();
  const core::ParticleSnapshot particles = columnAndSheet(kCameraCaseParticles);
  look.mutable_smoothing()->mutable_curvature_flow()->set_max_iterations(20);
  for (const int method : {0, 1, 2}) {
    if (method == 1) look.mutable_smoothing()->mutable_bilateral();
    if (method == 2) look.mutable_smoothing()->mutable_implicit_curvature_flow();
    const core::Frame first = render(particles, c.camera, c.size);
    for (const render::Resource resource : {render::Resource::Surface, render::Resource::Thickness}) {
      for (const float value : renderer.readBuffer(resource).values) {
        ASSERT_TRUE(std::isfinite(value)) << name(resource);
        ASSERT_GE(value, 0.0F) << name(resource);
      }
    }
    EXPECT_EQ(first.pixels, render(particles, c.camera, c.size).pixels);
  }
}

TEST_P(CameraCases, IsFiniteWithNoise) {
  const CameraCase& c = GetParam();
  core::ParticleSnapshot particles = columnAndSheet(kCameraCaseParticles);
  for (std::size_t i = 0; i < particles.size(); ++i) particles.ids.push_back(static_cast<std::uint32_t>(i));
  particles.velocities.assign(particles.size(), Eigen::Vector3f::Zero());
  look.mutable_noise()->set_amplitude(5);
  scene::complete(look);
  renderer.follow(particles, scene);
  for (Eigen::Vector3f& velocity : particles.velocities) velocity.y() = 100;
  particles.time = 0.1;
  const core::Frame first = render(particles, c.camera, c.size);
  for (const render::Resource resource : {render::Resource::Noise, render::Resource::Violence}) {
    for (const float value : renderer.readBuffer(resource).values) {
      ASSERT_TRUE(std::isfinite(value)) << name(resource);
    }
  }
  for (const float value : renderer.readRadiance().values) ASSERT_TRUE(std::isfinite(value));
  EXPECT_EQ(first.pixels, render(particles, c.camera, c.size).pixels);
}

TEST_P(CameraCases, IsFiniteForEveryShape) {
  const CameraCase& c = GetParam();
  core::ParticleSnapshot particles = columnAndSheet(kCameraCaseParticles);
  // Every tenth is spray.
  particles.densities.assign(particles.size(), 1000.0F);
  for (std::size_t i = 0; i < particles.size(); i += 10) particles.densities[i] = 100.0F;
  for (const char* shape : {"sphere", "ellipsoid", "disc"}) {
    v1::Splats& splats = *look.mutable_splats();
    splats.GetReflection()->MutableMessage(&splats, v1::Splats::descriptor()->FindFieldByName(shape));
    scene::complete(splats);
    const core::Frame first = render(particles, c.camera, c.size);
    for (const render::Resource resource : {render::Resource::Surface, render::Resource::Thickness}) {
      for (const float value : renderer.readBuffer(resource).values) {
        ASSERT_TRUE(std::isfinite(value)) << shape << ", " << name(resource);
        ASSERT_GE(value, 0.0F) << shape << ", " << name(resource);
      }
    }
    EXPECT_EQ(first.pixels, render(particles, c.camera, c.size).pixels);
  }
}

INSTANTIATE_TEST_SUITE_P(Every, CameraCases, ::testing::ValuesIn(cameraCases()),
                         [](const auto& testCase) { return testCase.param.name; });

class Clouds : public RenderTest {};

TEST_F(Clouds, OneTwoOrManyCoincidentParticles) {
  const Eigen::Vector3f p(0, 0, -2);
  for (const std::size_t count : {std::size_t{1}, std::size_t{2}, std::size_t{500}}) {
    render(cloud(std::vector<Eigen::Vector3f>(count, p), 0.2), alongZ(), {64, 64});
    const render::FloatPicture surface = renderer.readBuffer(render::Resource::Surface);
    EXPECT_GT(surface.values[32 * 64 + 32], 0.5F) << count;
    for (const float value : renderer.readBuffer(render::Resource::Thickness).values) EXPECT_TRUE(std::isfinite(value));
  }
}

TEST_F(Clouds, SplatsReachInFromOutsideThePicture) {
  // The centre is a whole radius beyond the left edge of the picture's middle row.
  look.mutable_smoothing()->set_time(0);
  const float edge = -2.0F * std::tan(0.5F * 45.0F * 3.14159265F / 180.0F);
  render(cloud({{edge - 0.1F, 0, -2}}, 0.2), alongZ(), {101, 101});
  const render::FloatPicture surface = renderer.readBuffer(render::Resource::Surface);
  EXPECT_GT(surface.values[50 * 101], 0.0F);
}

TEST_F(Clouds, ResizingGivesThePictureOfThatSize) {
  const core::ParticleSnapshot particles = columnAndSheet(800);
  const core::Frame before = render(particles, columnAndSheetCamera(), {80, 60});
  EXPECT_EQ(render(particles, columnAndSheetCamera(), {61, 47}).pixels.size(), 61U * 47U * 4U);
  EXPECT_EQ(before.pixels, render(particles, columnAndSheetCamera(), {80, 60}).pixels);
}

TEST_F(Clouds, ImpossibleSizesAreRefused) {
  const core::ParticleSnapshot particles = columnAndSheet(10);
  EXPECT_THROW(render(particles, alongZ(), {0, 10}), core::InputError);
  EXPECT_THROW(render(particles, alongZ(), {10, -1}), core::InputError);
  EXPECT_THROW(render(particles, alongZ(), {1 << 20, 1}), core::InputError);
}

}  // namespace
}  // namespace sluice::testing
