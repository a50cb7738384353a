// Study views, and values of the particles as colours: each is drawn, and what it does not need is left out.
#include <algorithm>
#include <iterator>
#include <random>
#include <set>
#include <string>

#include "palette.h"
#include "particle_values.h"
#include "render_test.h"

namespace sluice::testing {
namespace {

using ::testing::ValuesIn;

class Study : public RenderTest {
 protected:
  Study() {
    particles.sequence = 1;
    for (std::size_t i = 0; i < particles.size(); ++i) {
      const Eigen::Vector3f& p = particles.positions[i];
      particles.velocities.emplace_back(p.x(), 2.0F * p.y(), 0.0F);
      particles.densities.push_back(1000.0F + 10.0F * p.y());
      particles.pressures.push_back(9810.0F * (1.0F - p.y()));
      particles.ages.push_back(p.x());
      particles.ids.push_back(static_cast<std::uint32_t>(i));
    }
  }

  core::Frame draw() {
    ++particles.sequence;
    return render(particles, columnAndSheetCamera(), size);
  }

  bool ran(std::string_view pass) const {
    return std::ranges::any_of(renderer.plan().stages, [&](const auto& stage) { return stage.name == pass; });
  }

  static std::set<std::array<std::uint8_t, 3>> coloursOf(const core::Frame& frame) {
    std::set<std::array<std::uint8_t, 3>> colours;
    for (std::size_t i = 0; i < frame.pixels.size(); i += 4) {
      colours.insert({frame.pixels[i], frame.pixels[i + 1], frame.pixels[i + 2]});
    }
    return colours;
  }

  core::ParticleSnapshot particles = columnAndSheet(4000);
  /// The colour at the middle of a pixel, red, green, blue.
  std::array<int, 3> pixelOf(const core::Frame& frame, std::size_t i) const {
    return {frame.pixels[4 * i], frame.pixels[4 * i + 1], frame.pixels[4 * i + 2]};
  }
  std::string reason(std::string_view what) const {
    for (const core::LeftOut& entry : renderer.plan().leftOut) {
      if (entry.name == what) return entry.reason;
    }
    return "";
  }

  const core::ImageSize size{160, 120};
};

std::vector<std::string> membersOf(const google::protobuf::Descriptor& type, const char* oneof) {
  std::vector<std::string> names;
  const google::protobuf::OneofDescriptor& members = *type.FindOneofByName(oneof);
  for (int i = 0; i < members.field_count(); ++i) names.push_back(members.field(i)->name());
  return names;
}

template <class Message>
void choose(Message& message, const std::string& member) {
  message.GetReflection()->MutableMessage(&message, Message::descriptor()->FindFieldByName(member));
  scene::complete(message);
}

/// One for each member of View.shows.
class StudyView : public Study, public ::testing::WithParamInterface<std::string> {};

TEST_P(StudyView, ShowsTheLiquidAndNothingElse) {
  const core::Frame picture = draw();
  choose(*scene.mutable_view(), GetParam());
  const core::Frame view = draw();
  if (GetParam() == "picture") {
    EXPECT_EQ(view.pixels, picture.pixels);
    return;
  }
  EXPECT_TRUE(ran("study"));
  for (const char* const pass : {"background", "sunlight", "composite"}) EXPECT_FALSE(ran(pass)) << pass;
  EXPECT_EQ(ran("thickness"), GetParam() == "thickness");
  EXPECT_GT(coloursOf(view).size(), GetParam() == "points" ? 2U : 20U);
  const render::RadiancePicture light = renderer.readRadiance();
  EXPECT_TRUE(std::ranges::all_of(light.values, [](float value) { return std::isfinite(value); }));
  // Back to the picture as it was.
  choose(*scene.mutable_view(), "picture");
  EXPECT_EQ(draw().pixels, picture.pixels);
}

TEST_P(StudyView, ShowsSeveralLiquids) {
  choose(*scene.mutable_view(), GetParam());
  const core::Frame one = draw();
  for (std::size_t i = 0; i < particles.size(); ++i) particles.fluids.push_back(i % 2);
  const core::Frame two = draw();
  EXPECT_GT(coloursOf(two).size(), 2U);
  EXPECT_EQ(two.size, one.size);
}

/// Largest difference of two colours' components, of 255.
float difference(const std::array<int, 3>& shown, const Eigen::Vector3f& colour) {
  const Eigen::Vector3f pixel(static_cast<float>(shown[0]), static_cast<float>(shown[1]), static_cast<float>(shown[2]));
  return (pixel - 255.0F * colour).cwiseAbs().maxCoeff();
}

TEST_F(Study, NoiseIsBlueBelowTheSurfaceAndRedAboveIt) {
  choose(*scene.mutable_view(), "noise");
  scene.mutable_view()->set_legend(false);
  look.mutable_noise();
  scene::complete(look);
  look.mutable_noise()->set_still_share(1);
  const core::Frame frame = draw();
  const render::FloatPicture noise = renderer.readBuffer(render::Resource::Noise);
  const render::FloatPicture surface = renderer.readBuffer(render::Resource::Surface);
  ASSERT_EQ(noise.size, size);
  std::vector<float> heights;
  std::ranges::copy_if(noise.values, std::back_inserter(heights), [](float height) { return height != 0.0F; });
  const render::ValueRange range = render::robustRange(heights, true);
  EXPECT_EQ(range.least, -range.most);
  std::size_t compared = 0;
  for (std::size_t i = 0; i < noise.values.size(); ++i) {
    if (surface.values[i] <= 0) continue;
    const float share = (noise.values[i] - range.least) / range.width();
    EXPECT_LE(difference(pixelOf(frame, i), render::paletteColour(v1::ColourMap::kCoolWarm, share)), 2.0F) << i;
    ++compared;
  }
  EXPECT_GT(compared, 1000U);
}

TEST_F(Study, WithoutNoiseItsViewIsGrey) {
  choose(*scene.mutable_view(), "noise");
  const core::Frame frame = draw();
  const render::FloatPicture surface = renderer.readBuffer(render::Resource::Surface);
  for (std::size_t i = 0; i < surface.values.size(); ++i) {
    if (surface.values[i] <= 0) continue;
    const auto [red, green, blue] = pixelOf(frame, i);
    ASSERT_EQ(red, green) << i;
    ASSERT_EQ(red, blue) << i;
  }
  EXPECT_FALSE(ran("noise"));
  EXPECT_FALSE(ran("legend"));
  EXPECT_EQ(reason("noise"), "look.noise is not set");
}

TEST_F(Study, FoamIsAsLightAsItHides) {
  scene.mutable_foam();
  scene::complete(scene);
  std::mt19937 random(5);
  const auto uniform = [&] { return static_cast<float>(random() >> 8) * 0x1p-24F; };
  for (std::uint32_t i = 0; i < 3000; ++i) {
    particles.diffuse.ids.push_back(i);
    particles.diffuse.positions.emplace_back(2 * uniform(), 0.5F * uniform(), uniform());
    particles.diffuse.velocities.emplace_back(Eigen::Vector3f::Zero());
    particles.diffuse.kinds.push_back(static_cast<core::DiffuseKind>(i % 3));
    particles.diffuse.remaining.push_back(1);
  }
  choose(*scene.mutable_view(), "foam");
  scene.mutable_view()->set_legend(false);
  const core::Frame frame = draw();
  const render::FloatPicture foam = renderer.readBuffer(render::Resource::Foam);
  const render::FloatPicture surface = renderer.readBuffer(render::Resource::Surface);
  std::size_t foamy = 0;
  for (std::size_t i = 0; i < foam.values.size(); ++i) {
    const float share = 1.0F - std::exp(-foam.values[i]);
    // Beside the liquid, drops end softly.
    if (share < 0.05F && (surface.values[i] <= 0 || share > 0.0F)) continue;
    ASSERT_LE(difference(pixelOf(frame, i), render::paletteColour(v1::ColourMap::kMagma, share)), 2.0F) << i;
    if (share >= 0.05F) ++foamy;
  }
  EXPECT_GT(foamy, 50U);
  EXPECT_FALSE(ran("blend foam"));
  // Another view of the same scene does not spend time on it.
  choose(*scene.mutable_view(), "thickness");
  draw();
  EXPECT_FALSE(ran("foam"));
}

INSTANTIATE_TEST_SUITE_P(Every, StudyView, ValuesIn(membersOf(*v1::View::descriptor(), "shows")),
                         [](const auto& view) { return view.param; });

TEST_F(Study, CurvatureOfADropIsGreen) {
  choose(*scene.mutable_view(), "curvature");
  scene.mutable_view()->set_legend(false);
  look.mutable_smoothing()->set_time(0);
  particles = cloud({{0, 0, -2}}, 0.5);
  particles.sequence = 1;
  const core::Frame frame = render(particles, alongZ(), size);
  const std::size_t middle = 4 * static_cast<std::size_t>(size.height / 2 * size.width + size.width / 2);
  EXPECT_GT(frame.pixels[middle + 1], frame.pixels[middle] + 30);
}

/// One for each member of ColourMap.attribute.
class ColourOfAttribute : public Study, public ::testing::WithParamInterface<std::string> {};

TEST_P(ColourOfAttribute, CoversTheLiquid) {
  const core::Frame plain = draw();
  choose(*look.mutable_colour_map(), GetParam());
  const core::Frame coloured = draw();
  EXPECT_TRUE(ran("colour map"));
  EXPECT_NE(plain.pixels, coloured.pixels);
  look.mutable_colour_map()->set_strength(0);
  EXPECT_EQ(plain.pixels, draw().pixels);
}

TEST_P(ColourOfAttribute, IsLeftOutWhereTheSourceDoesNotTell) {
  particles = columnAndSheet(4000);
  const core::Frame plain = draw();
  choose(*look.mutable_colour_map(), GetParam());
  EXPECT_EQ(plain.pixels, draw().pixels);
  EXPECT_FALSE(ran("colour map"));
}

INSTANTIATE_TEST_SUITE_P(Every, ColourOfAttribute, ValuesIn(membersOf(*v1::ColourMap::descriptor(), "attribute")),
                         [](const auto& attribute) { return attribute.param; });

TEST_F(Study, VelocityMapWhitensWhatIsFast) {
  const core::Frame plain = draw();
  scene::complete(*look.mutable_velocity_map());
  const core::Frame white = draw();
  EXPECT_TRUE(ran("velocity map"));
  EXPECT_NE(plain.pixels, white.pixels);
  // Nothing is that fast.
  look.mutable_velocity_map()->set_to(1001);
  look.mutable_velocity_map()->set_from(1000);
  EXPECT_EQ(plain.pixels, draw().pixels);
}

}  // namespace
}  // namespace sluice::testing
