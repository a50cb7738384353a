// One picture per stage of a frame. Look at a picture before it becomes the golden.
#include <algorithm>
#include <string>
#include <vector>

#include "image_comparison.h"
#include "render_test.h"

namespace sluice::testing {
namespace {

using render::FloatPicture;
using render::Resource;

/// Grey from black, 0, to white, `white`.
core::Frame asGrey(const FloatPicture& picture, double black, double white) {
  core::Frame frame;
  frame.size = picture.size;
  for (const float value : picture.values) {
    const double grey = value > 0 ? std::clamp((value - black) / (white - black), 0.0, 1.0) : 0.0;
    const auto level = static_cast<std::uint8_t>(std::lround(255 * grey));
    frame.pixels.insert(frame.pixels.end(), {level, level, level, 255});
  }
  return frame;
}

class Golden : public RenderTest {
 protected:
  core::Frame draw() { return render(particles, camera, size); }
  /// The surface's inverse depth, 0.25 to 0.5 per metre.
  core::Frame surface() {
    draw();
    return asGrey(renderer.readBuffer(Resource::Surface), 0.25, 0.5);
  }

  core::ParticleSnapshot particles = columnAndSheet(8000);
  core::Camera camera = columnAndSheetCamera();
  core::ImageSize size{320, 240};
};

TEST_F(Golden, Background) {
  particles = cloud({}, 0.05);
  EXPECT_EQ(compareWithGolden("background", draw()), "");
}

TEST_F(Golden, Splats) {
  look.mutable_smoothing()->set_time(0);
  EXPECT_EQ(compareWithGolden("splats", surface()), "");
}

TEST_F(Golden, Ellipsoids) {
  look.mutable_smoothing()->set_time(0);
  look.mutable_splats()->mutable_ellipsoid();
  scene::complete(look);
  EXPECT_EQ(compareWithGolden("ellipsoids", surface()), "");
}

TEST_F(Golden, Discs) {
  look.mutable_smoothing()->set_time(0);
  look.mutable_splats()->mutable_disc();
  EXPECT_EQ(compareWithGolden("discs", surface()), "");
}

TEST_F(Golden, Spray) {
  // A jet of drops from the column's top over the sheet; the first are behind the column's edge.
  const std::size_t first = particles.size();
  for (int i = 0; i < 60; ++i) {
    const auto t = static_cast<float>(i) / 60.0F;
    const float turn = 2.4F * static_cast<float>(i);
    particles.positions.emplace_back(0.25F + 1.1F * t + 0.08F * std::cos(turn), 1.0F + 1.5F * t - 2.2F * t * t,
                                     0.5F + 0.15F * std::sin(turn));
  }
  particles.bounds = core::boundsOf(particles.positions);
  particles.densities.assign(particles.size(), 1000.0F);
  std::fill(particles.densities.begin() + static_cast<std::ptrdiff_t>(first), particles.densities.end(), 320.0F);
  EXPECT_EQ(compareWithGolden("spray", draw()), "");
}

TEST_F(Golden, Foam) {
  // From the column's foot outwards over the sheet: bubbles below, foam at and spray above its surface.
  scene.mutable_foam()->set_radius_in_spacings(0.12);
  scene::complete(scene);
  std::mt19937 random(3);
  const auto uniform = [&] { return static_cast<float>(random() >> 8) * 0x1p-24F; };
  for (std::uint32_t i = 0; i < 6000; ++i) {
    const float away = uniform() * uniform();
    const float height = 0.02F + 0.16F * uniform() + 0.6F * std::pow(uniform(), 8.0F);
    const bool inside = height < 0.09F;
    particles.diffuse.positions.emplace_back(0.5F + 1.2F * away, height, uniform());
    particles.diffuse.velocities.emplace_back(Eigen::Vector3f::Zero());
    particles.diffuse.kinds.push_back(inside           ? core::DiffuseKind::Bubble
                                      : height < 0.14F ? core::DiffuseKind::Foam
                                                       : core::DiffuseKind::Spray);
    particles.diffuse.remaining.push_back(uniform());
    particles.diffuse.ids.push_back(i);
  }
  EXPECT_EQ(compareWithGolden("foam", draw()), "");
}

/// A box half in the sheet, a ball before it and a cylinder behind the column, each of a colour of its own.
TEST_F(Golden, Bodies) {
  assign({"bodies[0].box.size=0.3,0.3,0.3", "bodies[0].position=1.1,0.1,0.6", "bodies[0].rotation_degrees=0,30,0",
          "bodies[0].matte.colour=0.75,0.2,0.12", "bodies[1].sphere.radius=0.16", "bodies[1].position=0.75,0.16,1.35",
          "bodies[1].matte={colour {x: 0.85 y: 0.75 z: 0.3} roughness: 0.15}",
          "bodies[2].cylinder={radius: 0.15 height: 1.1}", "bodies[2].position=0.2,0.55,-0.3",
          "bodies[2].matte.colour=0.3,0.55,0.3"});
  EXPECT_EQ(compareWithGolden("bodies", draw()), "");
}

TEST_F(Golden, Glass) {
  // A tank around the liquid: panes behind it, before it, and rims.
  assign({"bodies[0].box={size {x: 2.06 y: 1.2 z: 1.06} open_top: true}", "bodies[0].position=1,0.6,0.5",
          "bodies[0].glass={}"});
  EXPECT_EQ(compareWithGolden("glass", draw()), "");
}

/// One picture for each member of Smoothing.method, named like it.
class GoldenOfSmoothing : public Golden, public ::testing::WithParamInterface<std::string> {};

std::vector<std::string> smoothingMethods() {
  const google::protobuf::OneofDescriptor& methods = *v1::Smoothing::descriptor()->FindOneofByName("method");
  std::vector<std::string> names;
  for (int i = 0; i < methods.field_count(); ++i) names.push_back(methods.field(i)->name());
  return names;
}

TEST_P(GoldenOfSmoothing, Surface) {
  v1::Smoothing& smoothing = *look.mutable_smoothing();
  smoothing.GetReflection()->MutableMessage(&smoothing, v1::Smoothing::descriptor()->FindFieldByName(GetParam()));
  scene::complete(smoothing);
  // Its silhouette map gives up 3 σ of liquid all around: with as much smoothing as the others have, most of this one.
  if (smoothing.has_binomial()) smoothing.set_time(0.5);
  EXPECT_EQ(compareWithGolden(GetParam(), surface()), "");
}

INSTANTIATE_TEST_SUITE_P(Every, GoldenOfSmoothing, ::testing::ValuesIn(smoothingMethods()),
                         [](const auto& method) { return std::string(method.param); });

TEST_F(Golden, Normals) {
  scene.mutable_view()->mutable_normals();
  scene.mutable_view()->set_legend(false);
  EXPECT_EQ(compareWithGolden("normals", draw()), "");
}

TEST_F(Golden, Thickness) {
  look.mutable_thickness()->set_divisor(1);
  draw();
  EXPECT_EQ(compareWithGolden("thickness", asGrey(renderer.readBuffer(Resource::Thickness), 0, 1)), "");
}

TEST_F(Golden, Noise) {
  // The column is violent, the sheet is calm; the height is grey between -1 and 1 cm.
  for (std::size_t i = 0; i < particles.size(); ++i) particles.ids.push_back(static_cast<std::uint32_t>(i));
  particles.velocities.assign(particles.size(), Eigen::Vector3f::Zero());
  look.mutable_noise();
  scene::complete(look);
  renderer.follow(particles, scene);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (particles.positions[i].x() < 0.5F) particles.velocities[i] = {0, 5, 0};
  }
  particles.time = 0.04;
  draw();
  FloatPicture height = renderer.readBuffer(Resource::Noise);
  for (float& value : height.values) value += 0.01F;
  EXPECT_EQ(compareWithGolden("noise", asGrey(height, 0, 0.02)), "");
}

TEST_F(Golden, Composite) { EXPECT_EQ(compareWithGolden("composite", draw()), ""); }

TEST_F(Golden, CompositeOpaque) {
  look.mutable_liquid()->set_opaque(true);
  EXPECT_EQ(compareWithGolden("composite_opaque", draw()), "");
}

TEST_F(Golden, Sunlight) {
  // From high up, where the shadow falls towards the eye.
  sun.set_shadow(1);
  camera.eye = {-1.5F, 2.0F, -1.5F};
  EXPECT_EQ(compareWithGolden("sunlight", draw()), "");
}

}  // namespace
}  // namespace sluice::testing
