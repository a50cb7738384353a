// How light passes the liquid: every variant of the composite, and the back surface.
#include <array>

#include <google/protobuf/text_format.h>

#include "render_test.h"

namespace sluice::testing {
namespace {

using render::FloatPicture;
using render::Resource;

class Optics : public RenderTest {
 protected:
  void expectFinite(const std::string& what) {
    for (const float value : renderer.readRadiance().values) {
      ASSERT_TRUE(std::isfinite(value)) << what;
      ASSERT_GE(value, 0.0F) << what;
    }
  }

  void useTwoInterfaces() {
    look.mutable_liquid()->mutable_two_interfaces();
    scene::complete(look);
  }

  core::ParticleSnapshot particles = columnAndSheet(1500);
  core::ImageSize size{120, 90};
};

TEST_F(Optics, EveryVariantIsFiniteFromOutsideInsideAndGrazing) {
  const Eigen::Vector3f up(0, 1, 0);
  const Eigen::Vector3f middle(0.85F, 0.25F, 0.5F);
  const std::array cameras{columnAndSheetCamera(), core::Camera{{0.25F, 0.3F, 0.5F}, middle, up, 45},
                           core::Camera{{1.9F, 0.12F, 0.5F}, {0.2F, 0.11F, 0.5F}, up, 45}};
  // A strong, narrow highlight is what may leave the range of half floats.
  sun.set_strength(100);
  const auto drawAll = [&](const std::string& what) {
    for (const core::Camera& camera : cameras) {
      render(particles, camera, size);
      expectFinite(what);
    }
  };
  for (const char* const shading : {"physical {roughness: 0.01 specular: 10}", "phong {}", "physical {specular: 0}"}) {
    for (const char* const rest : {"snell {}", "screen_shift {}", "two_interfaces {}", "opaque: true",
                                   "opaque: true emission {x: 100 y: 1 z: 0}", "metal {}", "no_reflection {}"}) {
      const std::string liquid = std::string(rest) + " " + shading;
      ASSERT_TRUE(google::protobuf::TextFormat::ParseFromString(liquid, look.mutable_liquid()));
      scene::complete(look);
      drawAll(liquid);
    }
  }
}

TEST_F(Optics, BackSurfaceIsTheSameWithGlAloneAndWithout) {
  render::FluidRenderer onGpu(context(), render::DeviceTraits{.software = false});
  useTwoInterfaces();
  core::Camera near = columnAndSheetCamera();
  near.eye = {1.2F, 0.2F, 0.5F};
  near.target = {0.7F, 0.08F, 0.5F};
  for (const char* shape : {"sphere", "ellipsoid", "disc"}) {
    v1::Splats& splats = *look.mutable_splats();
    splats.GetReflection()->MutableMessage(&splats, v1::Splats::descriptor()->FindFieldByName(shape));
    scene::complete(splats);
    for (const core::Camera& camera : {columnAndSheetCamera(), near}) {
      for (const double time : {0.0, 0.001}) {
        look.mutable_smoothing()->set_time(time);
        // Of a surface as fine as the picture the CPU smooths a back of half the size.
        look.mutable_smoothing()->set_divisor(time > 0 ? 2 : 1);
        render(particles, camera, size);
        onGpu.render(particles, scene, camera, size);
        const FloatPicture native = renderer.readBuffer(Resource::BackSurface);
        const FloatPicture drawn = onGpu.readBuffer(Resource::BackSurface);
        ASSERT_EQ(native.values.size(), drawn.values.size());
        std::size_t filled = 0;
        std::size_t outlines = 0;
        for (std::size_t i = 0; i < native.values.size(); ++i) {
          filled += native.values[i] > 0 ? 1 : 0;
          if (std::abs(native.values[i] - drawn.values[i]) > 1e-4F * (native.values[i] + drawn.values[i])) ++outlines;
        }
        EXPECT_GT(filled, native.values.size() / 20);
        EXPECT_LE(outlines, 30U) << shape;
      }
    }
  }
}

TEST_F(Optics, BackOfHalfTheSizeIsCloseToThatOfTheWhole) {
  render::FluidRenderer onGpu(context(), render::DeviceTraits{.software = false});
  useTwoInterfaces();
  render(particles, columnAndSheetCamera(), size);
  onGpu.render(particles, scene, columnAndSheetCamera(), size);
  const FloatPicture front = renderer.readBuffer(Resource::Surface);
  const FloatPicture refined = renderer.readBuffer(Resource::BackSurface);
  const FloatPicture whole = onGpu.readBuffer(Resource::BackSurface);
  ASSERT_EQ(refined.values.size(), whole.values.size());
  std::size_t liquid = 0;
  std::size_t missing = 0;
  std::size_t off = 0;
  for (std::size_t i = 0; i < whole.values.size(); ++i) {
    if (front.values[i] <= 0 || whole.values[i] <= 0) continue;
    ++liquid;
    missing += refined.values[i] > 0 ? 0 : 1;
    off += std::abs(refined.values[i] - whole.values[i]) > 0.01F * whole.values[i] ? 1 : 0;
  }
  EXPECT_GT(liquid, whole.values.size() / 10);
  EXPECT_LE(missing, liquid / 1000);
  EXPECT_LE(off, liquid / 12) << "of so small a picture much is outline";
}

TEST_F(Optics, BackOfABallIsItsFarSide) {
  look.mutable_smoothing()->set_time(0);
  look.mutable_splats()->set_radius_in_spacings(1);
  useTwoInterfaces();
  render(cloud({{0, 0, -2}, {0, 0, -5}}, 0.2), alongZ(), {101, 101});
  const std::size_t middle = 50 * 101 + 50;
  EXPECT_NEAR(renderer.readBuffer(Resource::Surface).values[middle], 1 / 1.8, 1e-4);
  EXPECT_NEAR(renderer.readBuffer(Resource::BackSurface).values[middle], 1 / 5.2, 1e-4);
}

TEST_F(Optics, BackSurfaceIsThereForTwoInterfacesAlone) {
  render(particles, columnAndSheetCamera(), size);
  EXPECT_TRUE(renderer.readBuffer(Resource::BackSurface).values.empty());
  useTwoInterfaces();
  render(particles, columnAndSheetCamera(), size);
  EXPECT_FALSE(renderer.readBuffer(Resource::BackSurface).values.empty());
  look.mutable_liquid()->set_opaque(true);
  render(particles, columnAndSheetCamera(), size);
  EXPECT_TRUE(renderer.readBuffer(Resource::BackSurface).values.empty());
}

TEST_F(Optics, HighlightOfNoSunIsNone) {
  sun.set_strength(0);
  const core::Frame without = render(particles, columnAndSheetCamera(), size);
  sun.set_strength(1e-9);
  EXPECT_EQ(without.pixels, render(particles, columnAndSheetCamera(), size).pixels);
}

}  // namespace
}  // namespace sluice::testing
