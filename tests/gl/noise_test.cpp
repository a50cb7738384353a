// Noise that goes with the particles: with GL alone and without, on the surface, and left out.
#include <algorithm>

#include "render_test.h"

namespace sluice::testing {
namespace {

using render::FloatPicture;
using render::Resource;

class Noise : public RenderTest {
 protected:
  Noise() { useNoise(); }

  void useNoise() {
    look.mutable_noise();
    scene::complete(look);
  }

  static bool has(const core::Plan& plan, std::string_view buffer) {
    return std::ranges::any_of(plan.buffers, [&](const core::PlannedBuffer& b) { return b.name.starts_with(buffer); });
  }
  static bool ran(const core::Plan& plan, std::string_view pass) {
    return std::ranges::any_of(plan.stages, [&](const core::PlannedStage& s) { return s.name == pass; });
  }
  std::string reason(std::string_view what) const {
    for (const core::LeftOut& entry : renderer.plan().leftOut) {
      if (entry.name == what) return entry.reason;
    }
    return "";
  }

  /// The particles at two moments between which every second one is thrown up.
  void shake(render::FluidRenderer& on) {
    particles.velocities.assign(particles.size(), Eigen::Vector3f::Zero());
    particles.ids.resize(particles.size());
    for (std::size_t i = 0; i < particles.size(); ++i) particles.ids[i] = static_cast<std::uint32_t>(i);
    particles.time = 1;
    particles.sequence = 1;
    on.follow(particles, scene);
    for (std::size_t i = 0; i < particles.size(); i += 2) particles.velocities[i] = {0, 5, 0};
    particles.time = 1.04;
    particles.sequence = 2;
  }

  core::ParticleSnapshot particles = columnAndSheet(3000);
  core::Camera camera = columnAndSheetCamera();
  core::ImageSize size{200, 150};
};

TEST_F(Noise, IsTheSameWithGlAloneAndWithout) {
  render::FluidRenderer onGpu(context(), render::DeviceTraits{.software = false});
  shake(renderer);
  shake(onGpu);
  core::Camera near = camera;
  near.eye = {1.2F, 0.2F, 0.5F};
  near.target = {0.7F, 0.08F, 0.5F};
  for (const core::Camera& from : {camera, near}) {
    render(particles, from, size);
    onGpu.render(particles, scene, from, size);
    for (const Resource resource : {Resource::Noise, Resource::Violence}) {
      const FloatPicture a = renderer.readBuffer(resource);
      const FloatPicture b = onGpu.readBuffer(resource);
      ASSERT_EQ(a.size, b.size);
      float largest = 0;
      for (const float value : a.values) largest = std::max(largest, std::abs(value));
      ASSERT_GT(largest, 0.0F) << name(resource);
      std::size_t different = 0;
      for (std::size_t i = 0; i < a.values.size(); ++i) {
        if (std::abs(a.values[i] - b.values[i]) > 2e-3F * largest) ++different;
      }
      // Where round-off decides whether a pixel at an outline has liquid.
      EXPECT_LE(different, 30U) << name(resource);
    }
  }
}

TEST_F(Noise, MarksOfViolenceMakeItStrongerAndWhiter) {
  shake(renderer);
  const core::Frame shaken = render(particles, camera, size);
  const FloatPicture violence = renderer.readBuffer(Resource::Violence);
  EXPECT_GT(std::ranges::max(violence.values), 0.5F);
  EXPECT_LE(std::ranges::max(violence.values), 1.0F);
  const auto strength = [&] {
    double sum = 0;
    for (const float value : renderer.readBuffer(Resource::Noise).values) sum += std::abs(value);
    return sum;
  };
  const double violent = strength();
  render::FluidRenderer calm(context());
  const core::Frame still = calm.render(particles, scene, camera, size);
  EXPECT_EQ(std::ranges::max(calm.readBuffer(Resource::Violence).values), 0.0F);
  double quiet = 0;
  for (const float value : calm.readBuffer(Resource::Noise).values) quiet += std::abs(value);
  EXPECT_GT(violent, 2 * quiet);
  EXPECT_NE(shaken.pixels, still.pixels);
}

TEST_F(Noise, PictureMovesWithTheParticles) {
  // A wall of liquid that fills the picture, moved by whole pixels.
  particles = slab(2.0F, 1.3F, 0.06F);
  particles.ids.resize(particles.size());
  for (std::size_t i = 0; i < particles.size(); ++i) particles.ids[i] = static_cast<std::uint32_t>(7 * i);
  background.set_floor(false);
  look.mutable_smoothing()->set_time(0);
  look.mutable_noise()->set_still_share(1);
  size = {160, 120};
  render(particles, alongZ(), size);
  const FloatPicture before = renderer.readBuffer(Resource::Noise);
  // Pixels are of one size only at one depth: a few particles deep, errors stay far below a pixel.
  const float pixel = 2.0F * std::tan(22.5F * 3.14159265F / 180.0F) / 120.0F * 2.0F;
  for (Eigen::Vector3f& p : particles.positions) p.x() += 6 * pixel;
  render(particles, alongZ(), size);
  const FloatPicture after = renderer.readBuffer(Resource::Noise);
  double same = 0;
  double moved = 0;
  double all = 0;
  for (int y = 20; y < 100; ++y) {
    for (int x = 30; x < 130; ++x) {
      const auto at = [&](const FloatPicture& picture, int column) {
        return picture.values[static_cast<std::size_t>(y * 160 + column)];
      };
      moved += std::pow(at(after, x) - at(before, x - 6), 2);
      same += std::pow(at(after, x) - at(before, x), 2);
      all += std::pow(at(before, x), 2);
    }
  }
  EXPECT_LT(moved, 0.05 * all);
  EXPECT_GT(same, all);
}

TEST_F(Noise, DoesNotFlickerAtRest) {
  shake(renderer);
  const core::Frame first = render(particles, camera, size);
  // Sorted anew by the solver, at the same moment.
  std::ranges::reverse(particles.positions);
  std::ranges::reverse(particles.velocities);
  std::ranges::reverse(particles.ids);
  particles.sequence = 3;
  const core::Frame second = render(particles, camera, size);
  std::size_t different = 0;
  for (std::size_t i = 0; i < first.pixels.size(); ++i) {
    if (std::abs(first.pixels[i] - second.pixels[i]) > 1) ++different;
  }
  EXPECT_LT(different, first.pixels.size() / 500);
}

TEST_F(Noise, WithoutItThereIsNoPassAndNoBuffer) {
  look.clear_noise();
  const core::Frame without = render(particles, camera, size);
  EXPECT_FALSE(ran(renderer.plan(), "noise"));
  EXPECT_FALSE(has(renderer.plan(), "noise"));
  EXPECT_FALSE(has(renderer.plan(), "violence"));
  EXPECT_EQ(reason("noise"), "look.noise is not set");
  // Set, of no height: the same picture to the bit, and as little work.
  useNoise();
  look.mutable_noise()->set_amplitude(0);
  EXPECT_EQ(render(particles, camera, size).pixels, without.pixels);
  EXPECT_FALSE(has(renderer.plan(), "noise"));
  EXPECT_EQ(reason("noise"), "look.noise.amplitude is 0");
}

TEST_F(Noise, TooSmallToSeeGivesThePictureWithoutIt) {
  look.mutable_noise()->set_amplitude(1e-9);
  const core::Frame tiny = render(particles, camera, size);
  EXPECT_TRUE(ran(renderer.plan(), "noise"));
  look.clear_noise();
  EXPECT_EQ(render(particles, camera, size).pixels, tiny.pixels);
}

TEST_F(Noise, WithoutWhiteningThereIsNoBufferOfViolence) {
  look.mutable_noise()->set_whitening(0);
  shake(renderer);
  const core::Frame shaken = render(particles, camera, size);
  EXPECT_TRUE(has(renderer.plan(), "noise"));
  EXPECT_FALSE(has(renderer.plan(), "violence"));
  EXPECT_EQ(reason("whitening"), "look.noise.whitening is 0");
  // As little white that it rounds to none gives the same bits.
  look.mutable_noise()->set_whitening(1e-9);
  EXPECT_EQ(render(particles, camera, size).pixels, shaken.pixels);
  EXPECT_TRUE(has(renderer.plan(), "violence"));
}

TEST_F(Noise, PlanSaysWhatTheSourceLacks) {
  render(particles, camera, size);
  EXPECT_EQ(reason("marks of violent particles"), "the source gives no ids; noise goes by the places in its arrays");
  EXPECT_FALSE(has(renderer.plan(), "violence"));
  particles.ids.resize(particles.size());
  render(particles, camera, size);
  EXPECT_EQ(reason("marks of violent particles"), "the source gives no velocities");
  look.mutable_noise()->set_still_share(0);
  render(particles, camera, size);
  EXPECT_FALSE(ran(renderer.plan(), "noise"));
}

TEST_F(Noise, GoesWithEachOfSeveralLiquids) {
  particles.fluids.resize(particles.size());
  for (std::size_t i = 0; i < particles.size(); ++i) particles.fluids[i] = particles.positions[i].x() > 0.6F ? 1 : 0;
  scene.add_more_looks();
  scene::complete(scene);
  render(particles, camera, size);
  EXPECT_TRUE(ran(renderer.plan(), "noise"));
  EXPECT_FALSE(ran(renderer.plan(), "noise of liquid 2"));
  EXPECT_FALSE(renderer.readBuffer(Resource::Noise, 0).values.empty());
  EXPECT_TRUE(renderer.readBuffer(Resource::Noise, 1).values.empty());
}

}  // namespace
}  // namespace sluice::testing
