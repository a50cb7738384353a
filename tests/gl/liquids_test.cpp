// Several liquids in one picture, each with a surface and a look of its own.
#include <algorithm>

#include "render_test.h"

namespace sluice::testing {
namespace {

using render::Resource;

class Liquids : public RenderTest {
 protected:
  Liquids() {
    background.set_floor(false);
    look.mutable_smoothing()->set_time(1);
    *scene.add_more_looks() = look;
  }

  v1::Look& second() { return *scene.mutable_more_looks(0); }

  void paint(v1::Look& painted, double r, double g, double b) {
    v1::Liquid& liquid = *painted.mutable_liquid();
    liquid.set_opaque(true);
    liquid.mutable_colour()->set_x(r);
    liquid.mutable_colour()->set_y(g);
    liquid.mutable_colour()->set_z(b);
  }

  /// Slabs at two depths, one moved to the left and one to the right, that overlap in the middle of the picture.
  static core::ParticleSnapshot twoSlabs(std::uint8_t near, std::uint8_t far) {
    core::ParticleSnapshot both = slab(2.0F, 0.5F, 0.06F);
    const core::ParticleSnapshot behind = slab(3.0F, 0.8F, 0.06F);
    for (Eigen::Vector3f& p : both.positions) p.x() -= 0.3F;
    both.fluids.assign(both.size(), near);
    for (const Eigen::Vector3f& p : behind.positions) {
      both.positions.push_back(p + Eigen::Vector3f(0.4F, 0, 0));
      both.fluids.push_back(far);
    }
    both.bounds = core::boundsOf(both.positions);
    return both;
  }

  static core::ParticleSnapshot only(const core::ParticleSnapshot& all, std::uint8_t fluid) {
    core::ParticleSnapshot part = cloud({}, all.spacing);
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all.fluids[i] == fluid) part.positions.push_back(all.positions[i]);
    }
    part.bounds = core::boundsOf(part.positions);
    return part;
  }

  const core::ImageSize size{160, 120};
};

// Emitters and drains: a picture tells nothing of how many particles there were before.
TEST_F(Liquids, ParticlesMayComeAndGo) {
  const core::ParticleSnapshot all = twoSlabs(0, 1);
  core::ParticleSnapshot few = cloud({}, all.spacing);
  few.positions.assign(all.positions.begin(), all.positions.begin() + 40);
  few.fluids.assign(40, 0);
  few.bounds = core::boundsOf(few.positions);
  const core::ParticleSnapshot none = cloud({}, all.spacing);

  const core::Frame empty = render(none, alongZ(), size);
  const core::Frame sparse = render(few, alongZ(), size);
  const core::Frame full = render(all, alongZ(), size);
  EXPECT_NE(empty.pixels, sparse.pixels);
  EXPECT_NE(sparse.pixels, full.pixels);
  EXPECT_EQ(render(few, alongZ(), size).pixels, sparse.pixels);
  EXPECT_EQ(render(none, alongZ(), size).pixels, empty.pixels);
  EXPECT_EQ(render(all, alongZ(), size).pixels, full.pixels);
}

TEST_F(Liquids, OneOfTwoThatIsAloneIsDrawnAsAnyOther) {
  core::ParticleSnapshot particles = slab(2.0F, 0.5F, 0.06F);
  const core::Frame plain = render(particles, alongZ(), size);
  particles.fluids.assign(particles.size(), 1);
  EXPECT_EQ(plain.pixels, render(particles, alongZ(), size).pixels);
}

TEST_F(Liquids, DoNotShareContours) {
  const core::ParticleSnapshot both = twoSlabs(0, 1);
  render(both, alongZ(), size);
  const render::FloatPicture near = renderer.readBuffer(Resource::Surface, 0);
  const render::FloatPicture far = renderer.readBuffer(Resource::Surface, 1);
  render(only(both, 0), alongZ(), size);
  EXPECT_EQ(near.values, renderer.readBuffer(Resource::Surface).values);
  render(only(both, 1), alongZ(), size);
  EXPECT_EQ(far.values, renderer.readBuffer(Resource::Surface).values);
}

TEST_F(Liquids, TheirOrderInTheSceneIsNoMatter) {
  paint(look, 0.9, 0.1, 0.1);
  const core::Frame one = render(twoSlabs(0, 1), alongZ(), size);
  std::swap(look, second());
  const core::Frame other = render(twoSlabs(1, 0), alongZ(), size);
  EXPECT_EQ(one.pixels, other.pixels);
}

TEST_F(Liquids, NearOpaqueHidesWhatIsBehindIt) {
  paint(look, 0.9, 0.1, 0.1);
  paint(second(), 0.1, 0.1, 0.9);
  const core::ParticleSnapshot both = twoSlabs(0, 1);
  const core::Frame picture = render(both, alongZ(), size);
  const core::Frame near = render(only(both, 0), alongZ(), size);
  const render::FloatPicture front = renderer.readBuffer(Resource::Surface);
  // Away from its outline, where it covers pixels in part.
  std::size_t compared = 0;
  for (int y = 2; y < size.height - 2; ++y) {
    for (int x = 2; x < size.width - 2; ++x) {
      bool inside = true;
      for (int dy = -2; dy <= 2; ++dy) {
        for (int dx = -2; dx <= 2; ++dx) {
          inside = inside && front.values[static_cast<std::size_t>((y + dy) * size.width + x + dx)] > 0;
        }
      }
      if (!inside) continue;
      const auto at = static_cast<std::ptrdiff_t>(4 * (y * size.width + x));
      ++compared;
      ASSERT_TRUE(std::equal(picture.pixels.begin() + at, picture.pixels.begin() + at + 4, near.pixels.begin() + at));
    }
  }
  EXPECT_GT(compared, 1000U);
}

TEST_F(Liquids, ClearOnesShowWhatIsBehindThem) {
  look.mutable_liquid()->mutable_absorption()->set_x(0.5);
  paint(second(), 0.05, 0.05, 0.9);
  const core::ParticleSnapshot both = twoSlabs(0, 1);
  const core::Frame picture = render(both, alongZ(), size);
  const core::Frame near = render(only(both, 0), alongZ(), size);
  const auto pixel = [&](const core::Frame& frame) {
    const std::size_t at = 4 * static_cast<std::size_t>(size.height / 2 * size.width + size.width / 2);
    return std::vector<int>{frame.pixels[at], frame.pixels[at + 1], frame.pixels[at + 2]};
  };
  // The sky's red and green are gone, as the blue paint behind has hardly any.
  EXPECT_LT(pixel(picture)[0], pixel(near)[0] - 20);
  EXPECT_LT(pixel(picture)[1], pixel(near)[1] - 20);
}

TEST_F(Liquids, MayDifferInResolution) {
  second().mutable_smoothing()->set_divisor(2);
  const core::ParticleSnapshot both = twoSlabs(0, 1);
  render(both, alongZ(), size);
  EXPECT_EQ(renderer.readBuffer(Resource::Surface, 0).size, size);
  EXPECT_EQ(renderer.readBuffer(Resource::Surface, 1).size, (core::ImageSize{80, 60}));
}

}  // namespace
}  // namespace sluice::testing
