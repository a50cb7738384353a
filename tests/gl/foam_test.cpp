// Spray, foam and bubbles in the picture: native and GL alike, soft, and nothing at all where there are none.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "render_test.h"

namespace sluice::testing {
namespace {

using core::DiffuseKind;
using render::FloatPicture;
using render::Resource;

class FoamPicture : public RenderTest {
 protected:
  FoamPicture() {
    scene.mutable_foam();
    scene::complete(scene);
  }

  void add(const Eigen::Vector3f& position, DiffuseKind kind) {
    core::DiffuseParticles& diffuse = particles.diffuse;
    diffuse.ids.push_back(static_cast<std::uint32_t>(diffuse.size()));
    diffuse.positions.push_back(position);
    diffuse.velocities.emplace_back(Eigen::Vector3f::Zero());
    diffuse.kinds.push_back(kind);
    diffuse.remaining.push_back(1);
  }

  double totalOpticalDepth() {
    double sum = 0;
    for (const float value : renderer.readBuffer(Resource::Foam).values) sum += static_cast<double>(value);
    return sum;
  }

  bool ran(std::string_view pass) const {
    return std::ranges::any_of(renderer.plan().stages, [&](const auto& stage) { return stage.name == pass; });
  }

  core::ParticleSnapshot particles = columnAndSheet(3000);
  core::Camera camera = columnAndSheetCamera();
  core::ImageSize size{200, 150};
};

TEST_F(FoamPicture, IsTheSameWithGlAloneAndWithout) {
  std::mt19937 random(5);
  const auto uniform = [&] { return static_cast<float>(random() >> 8) * 0x1p-24F; };
  for (int i = 0; i < 3000; ++i) {
    add({2 * uniform(), 0.5F * uniform(), uniform()}, static_cast<DiffuseKind>(i % 3));
  }
  render::FluidRenderer onGpu(context(), render::DeviceTraits{.software = false});
  for (const unsigned divisor : {1U, 2U}) {
    look.mutable_smoothing()->set_divisor(divisor);
    render(particles, camera, size);
    onGpu.render(particles, scene, camera, size);
    const FloatPicture native = renderer.readBuffer(Resource::Foam);
    const FloatPicture gl = onGpu.readBuffer(Resource::Foam);
    ASSERT_EQ(native.size, gl.size);
    std::size_t different = 0;
    for (std::size_t i = 0; i < native.values.size(); ++i) {
      if (std::abs(native.values[i] - gl.values[i]) > 1e-3F + 1e-3F * native.values[i]) ++different;
    }
    // A dot whose middle is at the border of two pixels may find either's depth.
    EXPECT_LE(different, native.values.size() / 100) << "at 1/" << divisor;
    EXPECT_GT(totalOpticalDepth(), 100);
  }
}

TEST_F(FoamPicture, WithoutAnyIsThatOfASceneWithoutFoam) {
  const core::Frame none = render(particles, camera, size);
  EXPECT_FALSE(ran("foam"));
  EXPECT_FALSE(ran("blend foam"));
  EXPECT_TRUE(renderer.readBuffer(Resource::Foam).values.empty());
  add({50, 50, 50}, DiffuseKind::Spray);
  EXPECT_EQ(render(particles, camera, size).pixels, none.pixels) << "one that is out of the picture";
  EXPECT_FALSE(ran("foam"));
  add({1, 0.3F, 0.5F}, DiffuseKind::Spray);
  EXPECT_NE(render(particles, camera, size).pixels, none.pixels);
  scene.mutable_foam()->set_opacity(0);
  EXPECT_EQ(render(particles, camera, size).pixels, none.pixels);
  scene.clear_foam();
  EXPECT_EQ(render(particles, camera, size).pixels, none.pixels);
  EXPECT_FALSE(ran("foam"));
}

TEST_F(FoamPicture, HidesInTheMiddleWhatItsOpacitySays) {
  scene.mutable_foam()->set_opacity(0.75);
  scene.mutable_foam()->set_radius_in_spacings(1);
  add({1, 0.5F, 0.5F}, DiffuseKind::Foam);
  render(particles, camera, {800, 600});
  const float most = std::ranges::max(renderer.readBuffer(Resource::Foam).values);
  EXPECT_NEAR(1 - std::exp(-most), 0.75, 0.01);
}

TEST_F(FoamPicture, FadesBelowTheSurfaceWithoutAnEdge) {
  // A foam particle that goes straight away from the eye, from before the liquid to deep inside; large enough that
  // where in its pixel it lies hardly matters.
  scene.mutable_foam()->set_radius_in_spacings(0.5);
  // Along the middle of the pixel right and below of the picture's, lest it jumps from pixel to pixel.
  const core::ViewBasis basis = core::viewBasis(camera);
  const float half =
      std::tan(0.5F * camera.verticalFovDegrees * std::numbers::pi_v<float> / 180.0F) / static_cast<float>(size.height);
  const Eigen::Vector3f sight = basis.forward + half * basis.right - half * basis.up;
  render(particles, camera, size);
  const FloatPicture surface = renderer.readBuffer(Resource::Surface);
  const float middle = surface.values[static_cast<std::size_t>(75 * 200 + 100)];
  ASSERT_GT(middle, 0);
  const float front = 1 / middle;
  double before = -1;
  double first = 0;
  for (int i = 0; i <= 40; ++i) {
    particles.diffuse = {};
    const auto spacing = static_cast<float>(particles.spacing);
    add(camera.eye + (front + spacing * (0.25F * static_cast<float>(i) - 2)) * sight, DiffuseKind::Foam);
    render(particles, camera, size);
    const double now = totalOpticalDepth();
    if (i == 0) first = now;
    if (before >= 0) {
      EXPECT_LE(now, before * 1.2) << i;
      EXPECT_GE(now, before * 0.75 - 0.01 * first) << "an edge at " << i;
    }
    before = now;
  }
  EXPECT_LT(before, 0.1 * first);
}

TEST_F(FoamPicture, OfOneParticleKeepsItsWeightBelowAPixel) {
  // Far away dots get larger than they are, and as much fainter: what they hide goes with their area.
  scene.mutable_foam()->set_radius_in_spacings(0.2);
  particles.diffuse = {};
  add({1, 1.5F, 0.5F}, DiffuseKind::Spray);
  std::vector<double> hidden;
  for (const float times : {0.5F, 1.0F}) {
    core::Camera far = camera;
    far.eye = far.target + times * 4 * (camera.eye - camera.target);
    render(particles, far, size);
    const Eigen::Vector3f away = particles.diffuse.positions[0] - far.eye;
    const float depth = away.dot((far.target - far.eye).normalized());
    hidden.push_back(totalOpticalDepth() * static_cast<double>(depth * depth));
  }
  EXPECT_NEAR(hidden[1] / hidden[0], 1, 0.35);  // by where in its pixel a dot's middle lies
}

}  // namespace
}  // namespace sluice::testing
