// What the liquid mirrors of bodies and lamps, and what it leaves out.
#include <algorithm>

#include "render_test.h"
#include "view_geometry.h"

namespace sluice::testing {
namespace {

/// A pool of a perfect mirror under a blue sky, and a red box behind it that stands on its level.
class Reflection : public RenderTest {
 protected:
  Reflection() {
    background.set_floor(false);
    v1::Vec3& sky = *background.mutable_uniform()->mutable_radiance();
    sky.set_x(0);
    sky.set_y(0);
    sky.set_z(0.5);
    sun.set_shadow(0);
    v1::Liquid& liquid = *look.mutable_liquid();
    for (const auto set : {&v1::Vec3::set_x, &v1::Vec3::set_y, &v1::Vec3::set_z}) {
      (liquid.mutable_metal()->mutable_reflectance()->*set)(1);
    }
    liquid.mutable_physical()->set_specular(0);
    for (int layer = 0; layer < 3; ++layer) {
      for (int row = -30; row <= 30; ++row) {
        for (int column = -30; column <= 30; ++column) {
          pool.emplace_back(0.03F * static_cast<float>(column), -0.03F * static_cast<float>(layer),
                            0.03F * static_cast<float>(row));
        }
      }
    }
    scene::complete(scene);
  }

  v1::Body& addBox() {
    v1::Body& body = *scene.add_bodies();
    body.mutable_position()->set_y(box.center().y());
    body.mutable_position()->set_z(box.center().z());
    v1::Vec3& edges = *body.mutable_box()->mutable_size();
    edges.set_x(box.sizes().x());
    edges.set_y(box.sizes().y());
    edges.set_z(box.sizes().z());
    v1::Vec3& colour = *body.mutable_matte()->mutable_colour();
    colour.set_x(1);
    colour.set_y(0);
    colour.set_z(0);
    scene::complete(scene);
    return body;
  }

  core::Frame draw() {
    core::ParticleSnapshot liquid = cloud(pool, 0.03);
    liquid.sequence = ++sequence;
    return render(liquid, camera, size);
  }

  bool ran(std::string_view pass) const {
    return std::ranges::any_of(renderer.plan().stages, [&](const core::PlannedStage& s) { return s.name == pass; });
  }
  std::string whyNot(std::string_view what) const {
    const auto& leftOut = renderer.plan().leftOut;
    const auto found = std::ranges::find(leftOut, what, &core::LeftOut::name);
    return found == leftOut.end() ? "" : found->reason;
  }

  /// Whether a ray meets a box.
  static bool meets(const Eigen::AlignedBox3f& box, const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) {
    const Eigen::Array3f one = (box.min() - origin).array() / direction.array();
    const Eigen::Array3f other = (box.max() - origin).array() / direction.array();
    const float enters = std::max(one.min(other).maxCoeff(), 0.0F);
    return enters < one.max(other).minCoeff();
  }

  /// Pixels of the pool in which a mirror shows the box, by geometry and as drawn: both, and either.
  struct Overlap {
    int both = 0;
    int either = 0;
  };
  Overlap compare() {
    const render::RadiancePicture picture = renderer.readRadiance();
    const render::FloatPicture surface = renderer.readBuffer(render::Resource::Surface);
    const render::ViewGeometry view = render::makeViewGeometry(camera, size);
    const auto index = [&](int x, int y) { return static_cast<std::size_t>(y * size.width + x); };
    const auto placeAt = [&](int x, int y) -> Eigen::Vector3f {
      return view.eye + sightOf(view, x, y) / surface.values[index(x, y)];
    };
    Overlap overlap;
    for (int y = 1; y < size.height - 1; ++y) {
      for (int x = 1; x < size.width - 1; ++x) {
        const Eigen::Vector3f sight = sightOf(view, x, y);
        if (surface.values[index(x, y)] <= 0.0F || meets(box, view.eye, sight)) continue;
        const Eigen::Vector3f place = placeAt(x, y);
        if (place.cwiseAbs().maxCoeff() > 0.8F) continue;  // the pool is round at its rim
        const Eigen::Vector3f normal =
            (placeAt(x + 1, y) - placeAt(x - 1, y)).cross(placeAt(x, y + 1) - placeAt(x, y - 1)).normalized();
        const bool expected = meets(box, place, sight - 2.0F * normal.dot(sight) * normal);
        const std::size_t i = 4 * index(x, y);
        const bool drawn = picture.values[i] > 0.5F * picture.values[i + 2];
        overlap.both += expected && drawn ? 1 : 0;
        overlap.either += expected || drawn ? 1 : 0;
      }
    }
    return overlap;
  }

  /// The line of sight through the middle of a pixel, of length 1 along the view's axis.
  static Eigen::Vector3f sightOf(const render::ViewGeometry& view, int x, int y) {
    const Eigen::Vector2f pixel(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
    const Eigen::Vector2f whole(static_cast<float>(view.size.width), static_cast<float>(view.size.height));
    const Eigen::Vector2f slope = (pixel - 0.5F * whole) * view.pixelSlope;
    return view.forward + slope.x() * view.right + slope.y() * view.down;
  }

  Eigen::AlignedBox3f box{Eigen::Vector3f(-0.3F, 0.0F, -1.5F), Eigen::Vector3f(0.3F, 0.4F, -1.1F)};
  std::vector<Eigen::Vector3f> pool;
  core::Camera camera{{0, 1.1F, 2.2F}, {0, 0, -0.2F}, {0, 1, 0}, 40};
  core::ImageSize size{200, 150};
  std::uint64_t sequence = 0;
};

TEST_F(Reflection, OfABodyInTheCubeMapIsWhereAMirrorShowsIt) {
  addBox();
  look.mutable_liquid()->mutable_cube_map()->set_edge(256);
  draw();
  ASSERT_TRUE(ran("cube map"));
  const Overlap overlap = compare();
  EXPECT_GT(overlap.both, 300);
  EXPECT_GT(overlap.both, 0.9 * overlap.either);
}

TEST_F(Reflection, OfABodyInTheScreenIsWhereAMirrorShowsIt) {
  addBox();
  look.mutable_liquid()->mutable_screen_space()->set_body_depth(0.5);
  scene::complete(look);
  draw();
  EXPECT_EQ(whyNot("cube map"), "look.liquid.screen_space is chosen");
  const Overlap overlap = compare();
  EXPECT_GT(overlap.both, 300);
  EXPECT_GT(overlap.both, 0.9 * overlap.either);
}

TEST_F(Reflection, WithoutBodiesNeedsNoCubeMap) {
  const core::Frame withCube = draw();
  EXPECT_FALSE(ran("cube map"));
  EXPECT_EQ(whyNot("cube map"), "there is no body to mirror; floor and surroundings are mirrored as they are");
  look.mutable_liquid()->mutable_screen_space();
  scene::complete(look);
  EXPECT_EQ(draw().pixels, withCube.pixels);
  look.mutable_liquid()->mutable_surroundings();
  EXPECT_EQ(draw().pixels, withCube.pixels);
}

TEST_F(Reflection, OfABodyOutOfReachIsThatOfTheSurroundings) {
  // Far below the pool, where no mirrored ray goes.
  box.translate(Eigen::Vector3f(0, -50, 0));
  addBox();
  const core::Frame withCube = draw();
  EXPECT_TRUE(ran("cube map"));
  look.mutable_liquid()->mutable_surroundings();
  EXPECT_EQ(draw().pixels, withCube.pixels);
}

TEST_F(Reflection, KeepsItsCubeMapUntilSomethingMoves) {
  addBox();
  draw();
  camera.eye.x() = 0.5F;
  const core::Frame kept = draw();
  EXPECT_EQ(whyNot("cube map"), "bodies, light and the liquid's middle are those of the last frame");
  scene.mutable_bodies(0)->mutable_position()->set_x(0.1);
  draw();
  EXPECT_TRUE(ran("cube map"));
  scene.mutable_bodies(0)->mutable_position()->set_x(0);
  EXPECT_EQ(draw().pixels, kept.pixels);
  EXPECT_TRUE(ran("cube map"));
  for (Eigen::Vector3f& position : pool) position.x() += 0.2F;
  draw();
  EXPECT_TRUE(ran("cube map"));
}

TEST_F(Reflection, IsTakenOutsideABodyInTheLiquidsMiddle) {
  box = {Eigen::Vector3f(-0.1F, -0.2F, -0.1F), Eigen::Vector3f(0.1F, 0.4F, 0.1F)};
  std::erase_if(pool, [&](const Eigen::Vector3f& position) { return box.exteriorDistance(position) < 0.03F; });
  addBox();
  draw();
  const Overlap overlap = compare();
  EXPECT_GT(overlap.both, 100);
}

TEST_F(Reflection, LampsShineOnTheLiquid) {
  look.mutable_liquid()->clear_metal();
  look.mutable_liquid()->set_opaque(true);
  const core::Frame dark = draw();
  v1::PointLight& lamp = *scene.mutable_lighting()->add_point_lights();
  lamp.mutable_position()->set_y(0.5);
  scene::complete(scene);
  const core::Frame lit = draw();
  const std::size_t middle = 4 * static_cast<std::size_t>(size.height / 2 * size.width + size.width / 2);
  EXPECT_GT(lit.pixels[middle], dark.pixels[middle] + 20);

  // Its highlight is where a mirror shows the lamp: at z with 0.5/z = 1.1/(2.2 - z), 0.69 m before the middle.
  look.mutable_liquid()->mutable_physical()->set_specular(1);
  look.mutable_liquid()->mutable_physical()->set_roughness(0.05);
  lamp.set_strength(0.2);
  draw();
  const render::RadiancePicture picture = renderer.readRadiance();
  std::size_t brightest = 0;
  for (std::size_t i = 0; i < picture.values.size(); i += 4) {
    if (picture.values[i] > picture.values[brightest]) brightest = i;
  }
  const render::ViewGeometry view = render::makeViewGeometry(camera, size);
  const Eigen::Vector3f place = view.toView({0, 0, 2.2F * 0.5F / 1.6F});
  const Eigen::Vector2f expected = view.toPixel(place.head<2>() / place.z());
  EXPECT_NEAR(static_cast<float>(brightest / 4 % static_cast<std::size_t>(size.width)), expected.x(), 4);
  EXPECT_NEAR(static_cast<float>(brightest / 4 / static_cast<std::size_t>(size.width)), expected.y(), 6);
}

TEST_F(Reflection, RefractionShowsNoGhostOfABodyBeforeTheLiquid) {
  look.mutable_liquid()->clear_metal();
  box = {Eigen::Vector3f(-0.15F, 0.3F, 0.6F), Eigen::Vector3f(0.15F, 0.5F, 0.9F)};
  addBox();
  look.mutable_liquid()->mutable_surroundings();
  for (const std::string method : {"snell", "two_interfaces", "screen_shift"}) {
    v1::Liquid& liquid = *look.mutable_liquid();
    if (method == "snell") liquid.mutable_snell();
    if (method == "two_interfaces") liquid.mutable_two_interfaces();
    if (method == "screen_shift") liquid.mutable_screen_shift()->set_strength(1);
    scene::complete(look);
    draw();
    const render::RadiancePicture picture = renderer.readRadiance();
    const render::ViewGeometry view = render::makeViewGeometry(camera, size);
    const Eigen::AlignedBox3f around(box.min().array() - 0.03F, box.max().array() + 0.03F);
    int ghosts = 0;
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) {
        if (meets(around, view.eye, sightOf(view, x, y))) continue;
        const std::size_t i = 4 * static_cast<std::size_t>(y * size.width + x);
        if (picture.values[i] > 0.1F + 0.5F * picture.values[i + 2]) ++ghosts;
      }
    }
    EXPECT_EQ(ghosts, 0) << method;
  }
}

TEST_F(Reflection, OneColourBehindTheLiquidNeedsNoLookUp) {
  look.mutable_liquid()->clear_metal();
  for (const bool backdrop : {false, true}) {
    if (backdrop) background.mutable_backdrop();
    for (const auto refraction : {0, 1, 2}) {
      v1::Liquid& liquid = *look.mutable_liquid();
      if (refraction == 0) liquid.mutable_snell();
      if (refraction == 1) liquid.mutable_two_interfaces();
      if (refraction == 2) liquid.mutable_screen_shift();
      liquid.mutable_surroundings();
      scene.clear_bodies();
      scene::complete(scene);
      const core::Frame without = draw();
      EXPECT_EQ(whyNot("refraction's look-up"), "nothing but one colour is behind the liquid");
      // Behind the eye: it changes nothing, but that the plan does not know.
      box = {Eigen::Vector3f(-0.1F, 8, 9), Eigen::Vector3f(0.1F, 9, 10)};
      addBox();
      EXPECT_EQ(draw().pixels, without.pixels) << refraction << backdrop;
      EXPECT_EQ(whyNot("refraction's look-up"), "");
    }
  }
}

}  // namespace
}  // namespace sluice::testing
