// Every shape of splats, with GL alone and without, and what the look leaves to spray.
#include <numbers>

#include "render_test.h"

namespace sluice::testing {
namespace {

using render::FloatPicture;
using render::Resource;

/// The look chooses the shape of that name; the thickness is left as it is summed.
class SplatShapes : public RenderTest, public ::testing::WithParamInterface<const char*> {
 protected:
  SplatShapes() {
    v1::Splats& splats = *look.mutable_splats();
    const google::protobuf::FieldDescriptor* const shape = v1::Splats::descriptor()->FindFieldByName(GetParam());
    splats.GetReflection()->MutableMessage(&splats, shape);
    scene::complete(splats);
    look.mutable_thickness()->set_smoothing_in_spacings(0);
  }
};

/// Two pictures of floats that agree but for pixels at outlines, which round-off decides.
void expectAlike(const FloatPicture& a, const FloatPicture& b, double relative, std::size_t mostOutlines) {
  ASSERT_EQ(a.size, b.size);
  std::size_t outlines = 0;
  std::size_t filled = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    filled += a.values[i] > 0 ? 1 : 0;
    if (std::abs(a.values[i] - b.values[i]) > relative * (a.values[i] + b.values[i])) ++outlines;
  }
  EXPECT_GT(filled, a.values.size() / 20);
  EXPECT_LE(outlines, mostOutlines);
}

TEST_P(SplatShapes, AreTheSameWithGlAloneAndWithout) {
  render::FluidRenderer onGpu(context(), render::DeviceTraits{.software = false});
  const core::ParticleSnapshot particles = columnAndSheet(3000);
  const core::ImageSize size{200, 150};
  // From afar, and from so near that many splats are large or cut.
  core::Camera near = columnAndSheetCamera();
  near.eye = {1.2F, 0.2F, 0.5F};
  near.target = {0.7F, 0.08F, 0.5F};
  for (const core::Camera& camera : {columnAndSheetCamera(), near}) {
    for (const double time : {0.0, 0.001}) {
      look.mutable_smoothing()->set_time(time);
      render(particles, camera, size);
      onGpu.render(particles, scene, camera, size);
      expectAlike(renderer.readBuffer(Resource::Surface), onGpu.readBuffer(Resource::Surface), 1e-4, 30);
      expectAlike(renderer.readBuffer(Resource::Thickness), onGpu.readBuffer(Resource::Thickness), 1e-3, 10);
    }
  }
}

TEST_P(SplatShapes, HoldTheirVolume) {
  // As ThicknessOfABallHoldsItsVolume; here κ is each splat's own.
  std::vector<Eigen::Vector3f> ball;
  const float spacing = 0.1F;
  for (float z = -1; z <= 1; z += spacing) {
    for (float y = -1; y <= 1; y += spacing) {
      for (float x = -1; x <= 1; x += spacing) {
        if (x * x + y * y + z * z <= 1) ball.emplace_back(x, y, z - 60.0F);
      }
    }
  }
  const double expected = static_cast<double>(ball.size()) * std::pow(spacing, 3);
  const core::ImageSize size{400, 400};
  for (const unsigned divisor : {1U, 2U, 4U}) {
    look.mutable_thickness()->set_divisor(divisor);
    render(cloud(ball, spacing), alongZ(2.4F), size);
    const FloatPicture thickness = renderer.readBuffer(Resource::Thickness);
    double sum = 0;
    for (const float value : thickness.values) sum += value;
    const double pixel = 60 * 2 * std::tan(1.2 * std::numbers::pi / 180) / thickness.size.height;
    EXPECT_NEAR(sum * pixel * pixel, expected, 0.02 * expected) << "at 1/" << divisor;
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, SplatShapes, ::testing::Values("sphere", "ellipsoid", "disc"),
                         [](const auto& shape) { return std::string(shape.param); });

/// A slab whose densities are known, behind which or before which there is one more particle, which is stray.
class Spray : public RenderTest {
 protected:
  /// `depth` of the stray particle along the view axis, m; the slab's front is at about 2.
  static core::ParticleSnapshot slabAndStray(float depth) {
    core::ParticleSnapshot particles = slab(2.0F, 0.6F, 0.06F);
    particles.densities.assign(particles.size(), 1000.0F);
    particles.positions.emplace_back(0.02F, 0.01F, -depth);
    particles.densities.push_back(100.0F);
    particles.bounds = core::boundsOf(particles.positions);
    return particles;
  }

  static core::ParticleSnapshot without(core::ParticleSnapshot particles) {
    particles.positions.pop_back();
    particles.densities.pop_back();
    return particles;
  }

  bool ran(std::string_view pass) const {
    for (const core::PlannedStage& stage : renderer.plan().stages) {
      if (stage.name == pass) return true;
    }
    return false;
  }

  /// Pixels whose colour differs.
  static std::size_t changed(const core::Frame& a, const core::Frame& b) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.pixels.size(); i += 4) {
      count += std::equal(&a.pixels[i], &a.pixels[i] + 4, &b.pixels[i]) ? 0 : 1;
    }
    return count;
  }

  core::ImageSize size{160, 120};
};

TEST_F(Spray, IsNeitherSurfaceNorThickness) {
  sun.set_shadow(0);
  const core::ParticleSnapshot particles = slabAndStray(1.0F);
  const core::Frame with = render(particles, alongZ(), size);
  EXPECT_TRUE(ran("spray"));
  const FloatPicture surface = renderer.readBuffer(Resource::Surface);
  const FloatPicture thickness = renderer.readBuffer(Resource::Thickness);
  const core::Frame plain = render(without(particles), alongZ(), size);
  EXPECT_FALSE(ran("spray"));
  EXPECT_EQ(surface.values, renderer.readBuffer(Resource::Surface).values);
  EXPECT_EQ(thickness.values, renderer.readBuffer(Resource::Thickness).values);
  // A disc of 0.62 d at a depth of 1.
  const double radius = 0.62 * 0.06 / (2 * std::tan(22.5 * std::numbers::pi / 180) / size.height);
  EXPECT_GT(static_cast<double>(changed(with, plain)), 0.5 * std::numbers::pi * radius * radius);
  EXPECT_LT(static_cast<double>(changed(with, plain)), 1.3 * std::numbers::pi * radius * radius);
}

TEST_F(Spray, BehindTheLiquidIsHidden) {
  sun.set_shadow(0);
  for (const unsigned divisor : {1U, 2U}) {
    look.mutable_smoothing()->set_divisor(divisor);
    const core::Frame with = render(slabAndStray(3.0F), alongZ(), size);
    EXPECT_TRUE(ran("spray"));
    EXPECT_EQ(with.pixels, render(without(slabAndStray(3.0F)), alongZ(), size).pixels);
  }
}

TEST_F(Spray, SinksIntoTheLiquidWithoutAnEdge) {
  // The drop's middle goes through the surface: what it adds fades away little by little.
  sun.set_shadow(0);
  std::size_t before = 1U << 20;
  int steps = 0;
  for (float depth = 1.85F; depth < 2.05F; depth += 0.01F) {
    const std::size_t now =
        changed(render(slabAndStray(depth), alongZ(), size), render(without(slabAndStray(depth)), alongZ(), size));
    EXPECT_LE(now, before + 8);  // a pixel or two of the rim comes and goes
    steps += now != before ? 1 : 0;
    before = now;
  }
  EXPECT_GE(steps, 3);
  EXPECT_EQ(before, 0U);
}

TEST_F(Spray, AloneIsDrawnOverTheScene) {
  core::ParticleSnapshot drop = cloud({{0, 0, -1}}, 0.06);
  drop.densities = {100.0F};
  const core::Frame with = render(drop, alongZ(), size);
  EXPECT_TRUE(ran("spray"));
  EXPECT_FALSE(ran("composite"));
  const core::Frame none = render(cloud({}, 0.06), alongZ(), size);
  EXPECT_GT(changed(with, none), 10U);
}

TEST_F(Spray, FarDropsThinOutInsteadOfGrowing) {
  // Smaller than a pixel, drops fade; the sum of what they add goes down with the square of the distance.
  sun.set_shadow(0);
  background.set_floor(false);
  const auto added = [&](float depth) {
    core::ParticleSnapshot drops = cloud({}, 0.06);
    // Many, so that rounding to whole levels averages out.
    for (int i = 0; i < 400; ++i) {
      const float angle = static_cast<float>(i);
      const float reach = 0.2F * std::sqrt(static_cast<float>(i) / 400.0F) * depth;
      drops.positions.emplace_back(reach * std::cos(angle), reach * std::sin(angle), -depth);
    }
    drops.densities.assign(drops.size(), 100.0F);
    const core::Frame with = render(drops, alongZ(), size);
    const core::Frame none = render(cloud({}, 0.06), alongZ(), size);
    double sum = 0;
    for (std::size_t i = 0; i < with.pixels.size(); ++i) sum += std::abs(int{with.pixels[i]} - int{none.pixels[i]});
    return sum;
  };
  const double at10 = added(10);
  EXPECT_GT(at10, 0);
  EXPECT_NEAR(added(20) / at10, 0.25, 0.1);
}

}  // namespace
}  // namespace sluice::testing
