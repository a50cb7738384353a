// Leaving work out does not change the picture: each gate against a frame that does the work.
#include <algorithm>

#include "render_test.h"

namespace sluice::testing {
namespace {

class Gate : public RenderTest {
 protected:
  bool ran(std::string_view pass) const {
    for (const core::PlannedStage& stage : renderer.plan().stages) {
      if (stage.name == pass) return true;
    }
    return false;
  }
  /// Why the last frame did without it; empty where it did not.
  std::string whyNot(std::string_view what) const {
    for (const core::LeftOut& entry : renderer.plan().leftOut) {
      if (entry.name == what) return entry.reason;
    }
    return "";
  }
  core::Frame draw() { return render(particles, camera, size); }
  static void set(v1::Vec3& v, double x, double y, double z) {
    v.set_x(x);
    v.set_y(y);
    v.set_z(z);
  }
  /// Surroundings that shed no light: what mirrors them adds nothing. The sun remains, and shows an opaque liquid.
  void surroundWithBlack() {
    background.set_floor(false);
    set(*background.mutable_uniform()->mutable_radiance(), 0, 0, 0);
    look.mutable_liquid()->set_opaque(true);
    sun.set_strength(1);
  }

  core::ParticleSnapshot particles = columnAndSheet(3000);
  core::Camera camera = columnAndSheetCamera();
  core::ImageSize size{200, 150};
};

TEST_F(Gate, KeptBackgroundIsTheSame) {
  const core::Frame first = render(particles, camera, size);
  EXPECT_TRUE(ran("background"));
  const core::Frame second = render(particles, camera, size);
  EXPECT_FALSE(ran("background"));
  EXPECT_EQ(first.pixels, second.pixels);
}

TEST_F(Gate, KeptPictureIsTheSame) {
  particles.sequence = 7;
  const core::Frame first = render(particles, camera, size);
  const core::Frame kept = render(particles, camera, size);
  ASSERT_EQ(renderer.plan().stages.size(), 1U);
  EXPECT_TRUE(ran("tone map"));
  EXPECT_EQ(first.pixels, kept.pixels);
  look.mutable_liquid()->set_opaque(true);
  EXPECT_NE(render(particles, camera, size).pixels, kept.pixels);
  EXPECT_TRUE(ran("composite"));
}

TEST_F(Gate, BuffersThatShareMemoryDoNotDisturbEachOther) {
  // The to and fro of one liquid's filter lies in the memory of the next one's, over many frames.
  for (std::size_t i = 0; i < particles.size(); ++i) particles.fluids.push_back(i % 2);
  look.mutable_smoothing()->mutable_bilateral();
  scene::complete(look);
  const core::Frame first = render(particles, camera, size);
  const auto shares = [](const core::PlannedBuffer& buffer) {
    return buffer.name.find("in the memory of") != std::string::npos;
  };
  EXPECT_TRUE(std::ranges::any_of(renderer.plan().buffers, shares));
  look.mutable_smoothing()->mutable_implicit_curvature_flow();
  scene::complete(look);
  render(particles, camera, size);
  look.mutable_smoothing()->mutable_bilateral();
  scene::complete(look);
  EXPECT_EQ(first.pixels, render(particles, camera, size).pixels);
  EXPECT_EQ(first.pixels, render(particles, camera, size).pixels);
}

TEST_F(Gate, KeptShadowIsTheSame) {
  particles.sequence = 1;
  const core::Frame first = render(particles, camera, size);
  look.mutable_liquid()->mutable_physical()->set_specular(0.999);
  render(particles, camera, size);
  look.mutable_liquid()->mutable_physical()->set_specular(1);
  const core::Frame kept = render(particles, camera, size);
  particles.sequence = 2;
  const core::Frame again = render(particles, camera, size);
  EXPECT_EQ(first.pixels, kept.pixels);
  EXPECT_EQ(first.pixels, again.pixels);
}

TEST_F(Gate, ShadowIsThatOfParticlesThatCameWhileTheyWereOutOfView) {
  core::ParticleSnapshot few = columnAndSheet(300);
  few.sequence = 1;
  render(few, camera, size);
  // The other way: no liquid in the picture, no shadow in the plan.
  core::Camera away = camera;
  away.target = camera.eye + (camera.eye - camera.target);
  particles.sequence = 2;
  render(particles, away, size);
  EXPECT_FALSE(ran("sunlight"));
  const core::Frame back = render(particles, camera, size);
  particles.sequence = 3;
  EXPECT_EQ(back.pixels, render(particles, camera, size).pixels);
}

TEST_F(Gate, BackgroundIsDrawnAgainAfterASurfaceOfAnotherSize) {
  const core::Frame first = render(particles, camera, size);
  const core::Frame other = render(particles, camera, {100, 75});
  render(particles, camera, size);
  const render::FloatPicture surface{{100, 75}, std::vector<float>(100 * 75, 0.5F)};
  renderer.smooth(surface, look, particles.spacing, camera);
  EXPECT_EQ(other.pixels, render(particles, camera, {100, 75}).pixels);
  EXPECT_EQ(first.pixels, render(particles, camera, size).pixels);
}

TEST_F(Gate, NoSmoothingEqualsSmoothingByNothing) {
  // The least time that still runs every method moves no surface by as much as a bit of the picture.
  look.mutable_smoothing()->set_time(0);
  const core::Frame without = render(particles, camera, size);
  EXPECT_FALSE(ran("bilateral"));
  look.mutable_smoothing()->set_time(1e-12);
  look.mutable_smoothing()->mutable_bilateral();
  const core::Frame with = render(particles, camera, size);
  EXPECT_TRUE(ran("bilateral"));
  EXPECT_EQ(without.pixels, with.pixels);
}

TEST_F(Gate, HighlightWithoutSunlightIsTheSame) {
  // With the sun below the horizon no surface that faces up or to the eye catches its highlight.
  sun.mutable_direction()->set_x(0);
  sun.mutable_direction()->set_y(-1);
  sun.mutable_direction()->set_z(-1);
  core::Camera above = camera;
  above.eye = {0.8F, 2.5F, 0.6F};
  const core::ParticleSnapshot flat = slab(0.0F, 0.5F, 0.05F);
  core::ParticleSnapshot pool = flat;
  for (Eigen::Vector3f& p : pool.positions) p = {p.x() + 0.8F, 0.1F + 0.5F * p.z(), p.y() + 0.6F};
  above.target = {0.8F, 0.0F, 0.5F};
  look.mutable_liquid()->mutable_physical()->set_specular(0);
  const core::Frame without = render(pool, above, size);
  look.mutable_liquid()->mutable_physical()->set_specular(1e-30);
  const core::Frame with = render(pool, above, size);
  EXPECT_EQ(without.pixels, with.pixels);
}

TEST_F(Gate, ShadowOfNoStrengthIsTheSame) {
  sun.set_shadow(0);
  const core::Frame without = render(particles, camera, size);
  EXPECT_FALSE(ran("sunlight"));
  sun.set_shadow(1e-9);
  const core::Frame with = render(particles, camera, size);
  EXPECT_TRUE(ran("sunlight"));
  EXPECT_EQ(without.pixels, with.pixels);
}

TEST_F(Gate, NoReflectionIsAReflectionOfBlack) {
  surroundWithBlack();
  look.mutable_liquid()->mutable_surroundings();
  const core::Frame with = draw();
  EXPECT_EQ(whyNot("reflection"), "");
  look.mutable_liquid()->mutable_no_reflection();
  const core::Frame without = draw();
  EXPECT_EQ(whyNot("reflection"), "look.liquid.no_reflection is chosen");
  EXPECT_EQ(without.pixels, with.pixels);
  // The test can fail: of a bright world there is a reflection.
  set(*background.mutable_uniform()->mutable_radiance(), 1, 1, 1);
  const core::Frame dull = draw();
  look.mutable_liquid()->mutable_surroundings();
  EXPECT_NE(draw().pixels, dull.pixels);
}

TEST_F(Gate, BlackBackdropIsUniformDarkness) {
  surroundWithBlack();
  const core::Frame dark = draw();
  set(*background.mutable_backdrop()->mutable_colour(), 0, 0, 0);
  const core::Frame backdrop = draw();
  EXPECT_EQ(whyNot("reflection"), "a backdrop is not mirrored");
  EXPECT_EQ(backdrop.pixels, dark.pixels);
}

TEST_F(Gate, CausticsOfNoStrengthAreTheSame) {
  sun.set_caustics(0);
  const core::Frame without = draw();
  EXPECT_EQ(whyNot("caustics"), "lighting.sun.caustics is 0");
  EXPECT_TRUE(ran("sunlight")) << "for the shadow";
  sun.set_caustics(1e-9);
  const core::Frame with = draw();
  EXPECT_EQ(whyNot("caustics"), "");
  EXPECT_EQ(without.pixels, with.pixels);
  sun.set_caustics(1);
  EXPECT_NE(draw().pixels, without.pixels);
}

TEST_F(Gate, CausticsNeedALiquidThatRefracts) {
  look.mutable_liquid()->set_refractive_index(1);
  const core::Frame asked = draw();
  EXPECT_EQ(whyNot("caustics"), "no liquid lets light through and refracts it");
  sun.set_caustics(0);
  EXPECT_EQ(draw().pixels, asked.pixels);
}

TEST_F(Gate, SunOfNoStrengthIsTheSame) {
  sun.set_strength(0);
  const core::Frame without = draw();
  EXPECT_EQ(whyNot("sunlight"), "lighting.sun.strength is 0");
  EXPECT_EQ(whyNot("specular highlight"), "lighting.sun.strength is 0");
  sun.set_strength(1e-9);
  const core::Frame with = draw();
  EXPECT_TRUE(ran("sunlight"));
  EXPECT_EQ(without.pixels, with.pixels);
}

TEST_F(Gate, SunBelowTheHorizonHasNoShadowToBeStrong) {
  set(*sun.mutable_direction(), 0.4, -0.2, 0.3);
  const core::Frame strong = draw();
  EXPECT_EQ(whyNot("sunlight"), "the sun is at the horizon or below");
  sun.set_shadow(0);
  sun.set_caustics(0);
  EXPECT_EQ(draw().pixels, strong.pixels);
}

TEST_F(Gate, MapsOfNoStrengthAreTheSame) {
  scene.mutable_view()->set_legend(false);  // there is one, however little shows
  particles.velocities.assign(particles.size(), {0, 3, 0});
  const core::Frame without = draw();
  EXPECT_EQ(whyNot("velocity map"), "the look has none");
  look.mutable_velocity_map();
  look.mutable_colour_map();
  scene::complete(look);
  look.mutable_velocity_map()->set_strength(0);
  look.mutable_colour_map()->set_strength(0);
  EXPECT_EQ(draw().pixels, without.pixels);
  EXPECT_EQ(whyNot("velocity map"), "look.velocity_map.strength is 0");
  EXPECT_EQ(whyNot("colour map"), "look.colour_map.strength is 0");
  look.mutable_velocity_map()->set_strength(1e-9);
  look.mutable_colour_map()->set_strength(1e-9);
  EXPECT_EQ(draw().pixels, without.pixels);
  EXPECT_TRUE(ran("velocity map"));
  EXPECT_TRUE(ran("colour map"));
}

TEST_F(Gate, LampsOfNoStrengthAreTheSame) {
  const core::Frame without = draw();
  EXPECT_EQ(whyNot("lamps"), "lighting.point_lights is empty");
  set(*scene.mutable_lighting()->add_point_lights()->mutable_position(), 1, 0.3, 1.2);
  scene::complete(scene);
  scene.mutable_lighting()->mutable_point_lights(0)->set_strength(0);
  EXPECT_EQ(draw().pixels, without.pixels);
  scene.mutable_lighting()->mutable_point_lights(0)->set_strength(1);
  EXPECT_NE(draw().pixels, without.pixels);
}

TEST_F(Gate, NoParticlesShowTheBackground) {
  const core::Frame empty = render(cloud({}, 0.05), camera, size);
  const core::Frame behind = render(cloud({camera.eye + 5.0F * (camera.eye - camera.target)}, 0.05), camera, size);
  EXPECT_FALSE(ran("composite"));
  EXPECT_EQ(empty.pixels, behind.pixels);
}

TEST_F(Gate, OpaqueLiquidDoesNotDependOnThickness) {
  look.mutable_liquid()->set_opaque(true);
  look.mutable_thickness()->set_divisor(1);
  const core::Frame full = render(particles, camera, size);
  EXPECT_FALSE(ran("thickness"));
  look.mutable_thickness()->set_divisor(4);
  EXPECT_EQ(full.pixels, render(particles, camera, size).pixels);
}

TEST_F(Gate, NoStrayParticlesMeanNoSpray) {
  const core::Frame unknown = render(particles, camera, size);
  particles.densities.assign(particles.size(), 1000.0F);
  const core::Frame with = render(particles, camera, size);
  EXPECT_FALSE(ran("spray"));
  look.mutable_splats()->set_stray_density(0);
  const core::Frame without = render(particles, camera, size);
  EXPECT_EQ(unknown.pixels, with.pixels);
  EXPECT_EQ(unknown.pixels, without.pixels);
}

TEST_F(Gate, RadiusByDensityOfRestDensityIsTheSame) {
  particles.densities.assign(particles.size(), 1000.0F);
  const core::Frame without = render(particles, camera, size);
  look.mutable_splats()->set_radius_by_density(true);
  EXPECT_EQ(without.pixels, render(particles, camera, size).pixels);
}

TEST_F(Gate, FramesNameThePassesThatRan) {
  const core::Frame frame = render(particles, camera, size);
  std::vector<std::string> timed;
  for (const core::StageTime& stage : frame.tag.stages) timed.push_back(stage.name);
  for (const core::PlannedStage& stage : renderer.plan().stages) {
    EXPECT_NE(std::find(timed.begin(), timed.end(), stage.name), timed.end()) << stage.name;
  }
}

}  // namespace
}  // namespace sluice::testing
