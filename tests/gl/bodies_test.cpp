// Bodies and glass before, in and behind the liquid.
#include <algorithm>

#include "render_test.h"

namespace sluice::testing {
namespace {

class Bodies : public RenderTest {
 protected:
  Bodies() {
    background.set_floor(false);
    sun.set_shadow(0);
  }

  /// A ball of this radius straight ahead, of a red that no liquid has.
  v1::Body& addBall(float depth, double radius = 0.25) {
    v1::Body& body = *scene.add_bodies();
    body.mutable_position()->set_z(-depth);
    body.mutable_sphere()->set_radius(radius);
    v1::Vec3& colour = *body.mutable_matte()->mutable_colour();
    colour.set_x(1);
    colour.set_y(0);
    colour.set_z(0);
    scene::complete(scene);
    return body;
  }

  core::Frame draw() { return render(liquid, alongZ(), size); }
  bool ran(std::string_view pass) const {
    return std::ranges::any_of(renderer.plan().stages, [&](const core::PlannedStage& s) { return s.name == pass; });
  }
  /// Red minus green of the pixel in the middle, 0…255.
  int rednessInTheMiddle(const core::Frame& frame) const {
    const std::size_t i = 4 * static_cast<std::size_t>(size.height / 2 * size.width + size.width / 2);
    return frame.pixels[i] - frame.pixels[i + 1];
  }

  core::ParticleSnapshot liquid = slab(3, 1, 0.05F);
  core::ImageSize size{160, 120};
};

TEST_F(Bodies, BeforeTheLiquidHideIt) {
  addBall(2);
  const core::Frame over = draw();
  liquid = cloud({}, 0.05);
  const core::Frame alone = draw();
  EXPECT_GT(rednessInTheMiddle(over), 60);
  // All but the rim of the ball, which covers parts of pixels, is as without any liquid.
  const int reach = size.height / 12;
  for (int y = size.height / 2 - reach; y < size.height / 2 + reach; ++y) {
    for (int x = size.width / 2 - reach; x < size.width / 2 + reach; ++x) {
      for (int c = 0; c < 3; ++c) {
        const std::size_t i = 4 * static_cast<std::size_t>(y * size.width + x) + static_cast<std::size_t>(c);
        ASSERT_EQ(over.pixels[i], alone.pixels[i]) << x << ' ' << y;
      }
    }
  }
}

TEST_F(Bodies, BehindTheLiquidShowThroughIt) {
  const int without = rednessInTheMiddle(draw());
  addBall(4, 0.5);
  const core::Frame clear = draw();
  EXPECT_GT(rednessInTheMiddle(clear), without + 20);
  look.mutable_liquid()->set_opaque(true);
  EXPECT_LT(rednessInTheMiddle(draw()), rednessInTheMiddle(clear) - 20) << "not through an opaque liquid";
}

TEST_F(Bodies, InTheLiquidAreCutAtItsSurface) {
  look.mutable_liquid()->set_opaque(true);
  // Half before the front of the liquid: a cap of radius √(0.5² − 0.3²) = 0.4 m sticks out, at 3 m.
  addBall(3.3F, 0.5);
  const core::Frame frame = draw();
  int red = 0;
  for (int x = 0; x < size.width; ++x) {
    const std::size_t i = 4 * static_cast<std::size_t>(size.height / 2 * size.width + x);
    if (frame.pixels[i] - frame.pixels[i + 1] > 30) ++red;
  }
  const double pixelsPerMetre = size.height / (2 * std::tan(22.5 * M_PI / 180)) / 3.0;
  // The surface of the jittered slab is where splats are, up to half a spacing off: ±7 % of the cap.
  EXPECT_NEAR(red, 0.8 * pixelsPerMetre, 0.1 * pixelsPerMetre);
}

TEST_F(Bodies, HoldTheLiquidBeforeThemThin) {
  look.mutable_thickness()->set_divisor(1);
  draw();
  const auto middle = [&] {
    const render::FloatPicture thickness = renderer.readBuffer(render::Resource::Thickness);
    return thickness.values[static_cast<std::size_t>(size.height / 2 * size.width + size.width / 2)];
  };
  const float whole = middle();
  addBall(3.3F, 0.25);  // its front 0.05 m behind the liquid's
  draw();
  EXPECT_TRUE(ran("clip thickness"));
  const render::FloatPicture surface = renderer.readBuffer(render::Resource::Surface);
  const float front = 1.0F / surface.values[static_cast<std::size_t>(size.height / 2 * size.width + size.width / 2)];
  // The farthest of a pixel's samples counts: a pixel is 0.02 m wide here, where the ball falls back by 0.02²/2r. Besides,
  // its facets are up to 0.01 r inside it.
  EXPECT_LE(middle(), 3.05F - front + 4e-3F);
  EXPECT_GT(whole, 3.05F - front + 1e-2F);
}

TEST_F(Bodies, AreKeptWhileNothingMoves) {
  sun.set_shadow(1);
  addBall(2);
  const core::Frame first = draw();
  EXPECT_TRUE(ran("bodies"));
  EXPECT_TRUE(ran("body shadow"));
  const core::Frame kept = draw();
  EXPECT_FALSE(ran("bodies"));
  EXPECT_FALSE(ran("body shadow"));
  EXPECT_EQ(first.pixels, kept.pixels);
  liquid.bodies = {{.position = {0.3F, 0, -2}, .rotation = Eigen::Quaternionf::Identity()}};
  EXPECT_NE(draw().pixels, first.pixels) << "a body that moves is drawn anew";
  EXPECT_TRUE(ran("body shadow"));
}

TEST_F(Bodies, OutOfSightChangeNothing) {
  background.set_floor(true);
  background.set_floor_height(-1);
  const core::Frame without = draw();
  addBall(-500);  // far behind the eye
  const core::Frame with = draw();
  // Light times 1 − 10⁻⁷, which may fall on the other side of a half float.
  for (std::size_t i = 0; i < with.pixels.size(); ++i) ASSERT_LE(std::abs(with.pixels[i] - without.pixels[i]), 1);
  EXPECT_TRUE(ran("bodies"));
}

TEST_F(Bodies, LeaveNothingWhenNoneAreThere) {
  draw();
  for (const char* pass : {"bodies", "body shadow", "body edges", "clip thickness", "glass behind", "glass before"}) {
    EXPECT_FALSE(ran(pass)) << pass;
  }
  for (const core::PlannedBuffer& buffer : renderer.plan().buffers)
    EXPECT_EQ(buffer.name.find("scene depth"), std::string::npos);
}

TEST_F(Bodies, CastShadowsOnTheFloor) {
  background.set_floor(true);
  background.set_floor_height(-0.5);
  liquid = cloud({}, 0.05);
  addBall(3, 0.4);
  const auto brightness = [](const core::Frame& frame) {
    std::uint64_t sum = 0;
    for (const std::uint8_t value : frame.pixels) sum += value;
    return sum;
  };
  sun.set_shadow(1);
  const std::uint64_t shaded = brightness(draw());
  sun.set_shadow(0);
  EXPECT_LT(shaded + 10000, brightness(draw()));
}

TEST_F(Bodies, LampsLightTheFloor) {
  background.set_floor(true);
  background.set_floor_height(-0.5);
  liquid = cloud({}, 0.05);
  const core::Frame dark = draw();
  v1::PointLight& lamp = *scene.mutable_lighting()->add_point_lights();
  lamp.mutable_position()->set_z(-3);
  scene::complete(scene);
  const core::Frame lit = draw();
  for (std::size_t i = 0; i < lit.pixels.size(); ++i) ASSERT_GE(lit.pixels[i] + 1, dark.pixels[i]);
  EXPECT_NE(lit.pixels, dark.pixels);
}

TEST_F(Bodies, ClearGlassOfIndexOneIsUnseen) {
  v1::Body& pane = addBall(2);
  v1::Glass& glass = *pane.mutable_glass();
  glass.set_refractive_index(1);
  for (double component : {1.0}) {
    glass.mutable_tint()->set_x(component);
    glass.mutable_tint()->set_y(component);
    glass.mutable_tint()->set_z(component);
  }
  const core::Frame with = draw();
  EXPECT_TRUE(ran("glass behind"));
  scene.clear_bodies();
  const core::Frame without = draw();
  // Light times 1 − 10⁻⁸, which may fall on the other side of a half float.
  for (std::size_t i = 0; i < with.pixels.size(); ++i) ASSERT_LE(std::abs(with.pixels[i] - without.pixels[i]), 1);
}

TEST_F(Bodies, GlassTintsByTheSquareOfItsTwoWalls) {
  liquid = cloud({}, 0.05);
  scene.mutable_tone()->mutable_clip();
  const auto middle = [&] {
    draw();
    const render::RadiancePicture picture = renderer.readRadiance();
    return picture.values[4 * static_cast<std::size_t>(size.height / 2 * size.width + size.width / 2)];
  };
  const float without = middle();
  v1::Body& pane = addBall(2);
  v1::Glass& glass = *pane.mutable_glass();
  glass.set_refractive_index(1);
  glass.mutable_tint()->set_x(0.5);
  glass.mutable_tint()->set_y(1);
  glass.mutable_tint()->set_z(1);
  // Half floats hold 11 bits, and the middle pixel sees the ball half a pixel off its axis.
  EXPECT_NEAR(middle(), 0.25F * without, 2e-3F);
}

}  // namespace
}  // namespace sluice::testing
