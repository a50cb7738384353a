// Legends in pictures: their colours are those of the picture, and a kept picture keeps them.
#include "legend.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "legend_layout.h"
#include "render_test.h"

namespace sluice::testing {
namespace {

using render::FloatPicture;
using render::LegendLayout;
using render::Resource;
using render::Rgb8;
using render::ValueRange;

class LegendInPicture : public RenderTest {
 protected:
  LegendInPicture() {
    particles.sequence = 1;
    for (const Eigen::Vector3f& p : particles.positions) particles.velocities.emplace_back(p.x(), 2.0F * p.y(), 0.0F);
  }

  void useColourMap() {
    look.mutable_colour_map();
    scene::complete(look);
  }

  core::Frame draw() {
    ++particles.sequence;
    return render(particles, camera, size);
  }

  bool ran(std::string_view pass) const {
    return std::ranges::any_of(renderer.plan().stages, [&](const auto& stage) { return stage.name == pass; });
  }
  std::string reason(std::string_view what) const {
    for (const core::LeftOut& entry : renderer.plan().leftOut) {
      if (entry.name == what) return entry.reason;
    }
    return "";
  }

  Rgb8 pixelAt(const core::Frame& frame, int x, int y) const {
    const std::size_t at = 4 * static_cast<std::size_t>(y * size.width + x);
    return {frame.pixels[at], frame.pixels[at + 1], frame.pixels[at + 2]};
  }

  /// What the bar of the picture's only legend shows at a share of its length.
  Rgb8 barAt(const core::Frame& frame, float share) const {
    const LegendLayout layout = render::layOut({render::ColourBar{}}, size);
    const render::PixelBounds& panel = layout.panels[0];
    const int left = panel.left + layout.padding;
    const int width = panel.right - layout.padding - left;
    const int x = left + std::min(static_cast<int>(share * static_cast<float>(width)), width - 1);
    return pixelAt(frame, x, panel.top + layout.padding + static_cast<int>(1.6F * static_cast<float>(layout.em)));
  }

  static int difference(const Rgb8& a, const Rgb8& b) {
    int most = 0;
    for (std::size_t c = 0; c < 3; ++c) most = std::max(most, std::abs(int{a[c]} - int{b[c]}));
    return most;
  }

  core::ParticleSnapshot particles = columnAndSheet(4000);
  core::Camera camera = columnAndSheetCamera();
  core::ImageSize size{640, 480};
};

TEST_F(LegendInPicture, HasTheColoursOfDepth) {
  scene.mutable_view()->mutable_smoothed_depth();
  const core::Frame frame = draw();
  const FloatPicture surface = renderer.readBuffer(Resource::Surface);
  std::vector<float> depths;
  for (const float q : surface.values) {
    if (q > 0) depths.push_back(1.0F / q);
  }
  const ValueRange range = render::robustRange(depths, false);
  const render::PixelBounds panel = render::layOut({render::ColourBar{}}, size).panels[0];
  int compared = 0;
  for (int y = 0; y < panel.top; y += 3) {
    for (int x = 0; x < size.width; x += 3) {
      const float q = surface.values[static_cast<std::size_t>(y * size.width + x)];
      if (q <= 0) continue;
      const float share = std::clamp((1.0F / q - range.least) / range.width(), 0.0F, 1.0F);
      // A pixel of the bar spans more than one of 256 colours.
      ASSERT_LE(difference(pixelAt(frame, x, y), barAt(frame, share)), 6) << x << ", " << y;
      ++compared;
    }
  }
  EXPECT_GT(compared, 1000);
}

TEST_F(LegendInPicture, HasTheColoursOfTheMapUnderEveryTone) {
  // A wall that fills the picture and faces the eye, all of one speed.
  particles = slab(2.0F, 1.3F, 0.06F);
  particles.velocities.assign(particles.size(), Eigen::Vector3f(0.35F, 0, 0));
  camera = alongZ();
  useColourMap();
  look.mutable_colour_map()->set_most(1);
  look.mutable_smoothing()->set_time(20);
  const std::array<std::function<void()>, 5> tones{
      [&] { scene.mutable_tone()->mutable_soft_clip(); }, [&] { scene.mutable_tone()->mutable_filmic(); },
      [&] { scene.mutable_tone()->mutable_reinhard(); }, [&] { scene.mutable_tone()->mutable_clip(); },
      [&] { scene.mutable_tone()->set_exposure(-1.5); }};
  for (std::size_t i = 0; i < tones.size(); ++i) {
    tones[i]();
    for (const bool viridis : {true, false}) {
      viridis ? (void)look.mutable_colour_map()->mutable_viridis() : (void)look.mutable_colour_map()->mutable_magma();
      const core::Frame frame = draw();
      EXPECT_TRUE(ran("legend"));
      // What is turned a little from the eye is a little darker.
      EXPECT_LE(difference(pixelAt(frame, size.width / 2, size.height / 2), barAt(frame, 0.35F)), 6) << i;
    }
  }
}

TEST_F(LegendInPicture, HasTheColoursOfNormals) {
  scene.mutable_view()->mutable_normals();
  look.mutable_smoothing()->set_time(0);
  look.mutable_splats()->set_radius_in_spacings(1);
  particles = cloud({{0, 0, -20}}, 1);
  camera = alongZ(8);
  const core::Frame frame = draw();
  const LegendLayout layout = render::layOut({render::NormalBall{}}, size);
  const render::PixelBounds& panel = layout.panels[0];
  const float radius = 2.2F * static_cast<float>(layout.em);
  const int ballX = panel.left + layout.padding + static_cast<int>(radius);
  const int ballY =
      panel.top + layout.padding + static_cast<int>(std::lround(1.35F * static_cast<float>(layout.em)) + radius);
  const float large = 0.5F * static_cast<float>(size.height) / (20.0F * std::tan(4.0F * 3.14159265F / 180.0F));
  for (const auto& [right, up] : {std::pair(0.0F, 0.0F), {0.6F, 0.0F}, {-0.6F, 0.0F}, {0.0F, 0.6F}, {0.0F, -0.6F}}) {
    const auto at = [&](int x, int y, float r) {
      return pixelAt(frame, x + static_cast<int>(std::lround(right * r)), y - static_cast<int>(std::lround(up * r)));
    };
    // A pixel of the small ball spans a slope of 1/20.
    EXPECT_LE(difference(at(size.width / 2, size.height / 2, large), at(ballX, ballY, radius)), 14) << right << up;
  }
}

TEST_F(LegendInPicture, LeavesTheRestOfThePictureAlone) {
  useColourMap();
  const core::Frame with = draw();
  scene.mutable_view()->set_legend(false);
  const core::Frame without = draw();
  EXPECT_EQ(reason("legend"), "view.legend is off");
  const render::PixelBounds panel = render::layOut({render::ColourBar{}}, size).panels[0];
  std::size_t changed = 0;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const bool within = x >= panel.left && x < panel.right && y >= panel.top && y < panel.bottom;
      if (!within) {
        ASSERT_EQ(pixelAt(with, x, y), pixelAt(without, x, y)) << x << ", " << y;
      } else if (pixelAt(with, x, y) != pixelAt(without, x, y)) {
        ++changed;
      }
    }
  }
  EXPECT_GT(changed, 1000U);
}

TEST_F(LegendInPicture, IsKeptWithThePicture) {
  useColourMap();
  const core::Frame first = draw();
  const core::Frame kept = render(particles, camera, size);
  EXPECT_EQ(renderer.plan().stages.size(), 2U);
  EXPECT_EQ(first.pixels, kept.pixels);
  // And is gone with its colours.
  look.clear_colour_map();
  const core::Frame plain = draw();
  EXPECT_FALSE(ran("legend"));
  EXPECT_EQ(render(particles, camera, size).pixels, plain.pixels);
}

TEST_F(LegendInPicture, HasOneForEachLiquidWithColours) {
  useColourMap();
  for (std::size_t i = 0; i < particles.size(); ++i) particles.fluids.push_back(i % 2);
  v1::Look& second = *scene.add_more_looks();
  scene::complete(second);
  const core::Frame one = draw();
  *second.mutable_colour_map() = look.colour_map();
  const core::Frame two = draw();
  const render::PixelBounds upper = render::layOut({render::ColourBar{}, render::ColourBar{}}, size).panels[0];
  // The margin beside the upper panel's title is that of a panel, dark, where there was picture.
  const Rgb8 before = pixelAt(one, upper.right - 8, upper.top + 4);
  const Rgb8 after = pixelAt(two, upper.right - 8, upper.top + 4);
  EXPECT_LT(int{after[0]} + after[1] + after[2], int{before[0]} + before[1] + before[2]);
}

TEST_F(LegendInPicture, IsTheSameOnADevice) {
  scene.mutable_view()->mutable_thickness();
  render::FluidRenderer onGpu(context(), render::DeviceTraits{.software = false});
  const core::Frame native = draw();
  const core::Frame gl = onGpu.render(particles, scene, camera, size);
  for (float share = 0; share <= 1; share += 0.125F) EXPECT_EQ(barAt(native, share), barAt(gl, share)) << share;
}

TEST_F(LegendInPicture, IsLeftOutOfSmallPictures) {
  useColourMap();
  size = {100, 75};
  draw();
  EXPECT_FALSE(ran("legend"));
  EXPECT_EQ(reason("legend"), "the picture is too small to hold it");
}

}  // namespace
}  // namespace sluice::testing
