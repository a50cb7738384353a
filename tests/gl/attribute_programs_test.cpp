// Values of particles brought to the surface on a device are those that the CPU brings there.
#include "attribute_programs.h"

#include <algorithm>
#include <cmath>

#include "frame_context.h"
#include "render_test.h"

namespace sluice::testing {
namespace {

using render::FloatPicture;
using render::Resource;
using render::ViewGeometry;
using render::ViewValue;

class AttributesOnDevice : public RenderTest {
 protected:
  /// What the programs make of particles at a surface.
  static std::vector<float> draw(std::span<const ViewValue> particles, float radius, const std::vector<float>& surface,
                                 const ViewGeometry& surfaceView, const ViewGeometry& view) {
    const gl::Texture depth = gl::makeTexture(GL_R32F, surfaceView.size);
    glTextureSubImage2D(depth.name(), 0, 0, 0, surfaceView.size.width, surfaceView.size.height, GL_RED, GL_FLOAT,
                        surface.data());
    const gl::Texture sums = gl::makeTexture(GL_RG32F, view.size);
    const gl::Texture values = gl::makeTexture(GL_R32F, view.size);
    const gl::Framebuffer toSums = gl::makeFramebuffer(sums);
    const gl::Framebuffer toValues = gl::makeFramebuffer(values);
    constexpr std::array<GLfloat, 4> kNothing{};
    glClearNamedFramebufferfv(toSums.name(), GL_COLOR, 0, kNothing.data());

    render::AttributePrograms programs;
    glViewport(0, 0, view.size.width, view.size.height);
    glBindFramebuffer(GL_FRAMEBUFFER, toSums.name());
    glBindTextureUnit(0, depth.name());
    programs.sum(particles, radius, surfaceView, view);
    glDisable(GL_BLEND);
    glBindFramebuffer(GL_FRAMEBUFFER, toValues.name());
    glBindTextureUnit(0, sums.name());
    glUseProgram(programs.finish().name());
    const gl::VertexArray nothing = gl::makeVertexArray();
    glBindVertexArray(nothing.name());
    render::drawPicture();

    std::vector<float> result(static_cast<std::size_t>(view.size.width) * static_cast<std::size_t>(view.size.height));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, toValues.name());
    glReadPixels(0, 0, view.size.width, view.size.height, GL_RED, GL_FLOAT, result.data());
    return result;
  }
};

TEST_F(AttributesOnDevice, AreThoseOfTheCpu) {
  const core::Camera camera = columnAndSheetCamera();
  const core::ParticleSnapshot particles = columnAndSheet(4000);
  const auto radius = static_cast<float>(0.9 * particles.spacing);
  for (const core::ImageSize size : {core::ImageSize{200, 150}, core::ImageSize{161, 121}}) {
    render(particles, camera, size);
    const FloatPicture surface = renderer.readBuffer(Resource::Surface);
    const ViewGeometry surfaceView = render::makeViewGeometry(camera, size);
    const ViewGeometry view = render::divided(surfaceView, 2);
    std::vector<ViewValue> values;
    for (const Eigen::Vector3f& position : particles.positions) {
      const Eigen::Vector3f p = surfaceView.toView(position);
      if (p.z() > 0.1F) values.push_back({p.x(), p.y(), p.z(), 3.0F * std::sin(20.0F * position.x()) + position.y()});
    }
    std::vector<float> onCpu(static_cast<std::size_t>(view.size.width) * static_cast<std::size_t>(view.size.height));
    render::AttributeRaster().draw(values, radius, surface.values, surfaceView, view, onCpu);
    const std::vector<float> onDevice = draw(values, radius, surface.values, surfaceView, view);
    const auto [least, most] = std::ranges::minmax(onCpu);
    const float range = most - least;
    ASSERT_GT(range, 3.0F);
    std::size_t compared = 0;
    for (std::size_t i = 0; i < onCpu.size(); ++i) {
      // At the rim of what anything reaches, round-off decides between a value and none; no liquid is there.
      if (onCpu[i] == 0.0F || onDevice[i] == 0.0F) continue;
      ASSERT_NEAR(onCpu[i], onDevice[i], 1e-4F * range) << i;
      ++compared;
    }
    EXPECT_GT(compared, 1000U);
    const auto reached = [](const std::vector<float>& picture) {
      return std::ranges::count_if(picture, [](float value) { return value != 0.0F; });
    };
    EXPECT_NEAR(static_cast<double>(reached(onCpu)), static_cast<double>(reached(onDevice)), 20);
  }
}

TEST_F(AttributesOnDevice, ColourTheSamePicture) {
  core::ParticleSnapshot particles = columnAndSheet(4000);
  for (const Eigen::Vector3f& p : particles.positions) particles.velocities.emplace_back(p.x(), 2.0F * p.y(), 0.0F);
  look.mutable_colour_map();
  scene::complete(look);
  const core::Camera camera = columnAndSheetCamera();
  const core::ImageSize size{200, 150};
  render::FluidRenderer onGpu(context(), render::DeviceTraits{.software = false});
  render(particles, camera, size);
  onGpu.render(particles, scene, camera, size);
  const FloatPicture native = renderer.readBuffer(Resource::Attribute);
  const FloatPicture gl = onGpu.readBuffer(Resource::Attribute);
  ASSERT_EQ(native.size, gl.size);
  ASSERT_EQ(native.size, (core::ImageSize{100, 75}));
  const float most = std::ranges::max(native.values);
  ASSERT_GT(most, 1.0F);
  std::size_t different = 0;
  for (std::size_t i = 0; i < native.values.size(); ++i) {
    if (std::abs(native.values[i] - gl.values[i]) > 1e-3F * most) ++different;
  }
  // Where round-off decides whether a pixel at an outline has liquid.
  EXPECT_LE(different, native.values.size() / 100);
}

}  // namespace
}  // namespace sluice::testing
