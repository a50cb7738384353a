// Every program that a pass may ask for compiles and links, and every shader and flag is one that some pass asks for.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "composite_variant.h"
#include "frame_context.h"
#include "sluice/gl/context.h"
#include "sluice/scene/scene.h"

namespace sluice::render {
namespace {

using Defines = std::vector<std::string_view>;

/// Programs of one pair of shaders: one for each combination of a choice and any of the flags.
struct Family {
  std::string_view vertex;
  std::string_view fragment;
  std::vector<Defines> choices{{}};
  Defines flags{};
  Defines idle{};  ///< Flags that files included by it know, and this pass has no use for.
};

const std::vector<Defines> kSplatShapes{{}, {"ELLIPSOID"}, {"DISC"}};
const std::vector<Defines> kLargeSplatShapes{{"LARGE"}, {"LARGE", "ELLIPSOID"}, {"LARGE", "DISC"}};
const Defines kLiquidFront{"LIQUID", "LAYERED", "BODIES"};

/// What the passes ask for, but for the composite, whose variants are counted below.
const std::vector<Family> kFamilies{
    {"background.vert", "background.frag"},
    {"background.vert", "background.frag", {{"FLOOR"}}, {"BODIES", "LAMPS"}},
    {"bodies.vert", "bodies.frag", {{}, {"SHADOW"}}},
    {"bodies.vert", "bodies.frag", {{}}, {"CUBE_MAP", "SCREEN_SPACE_NORMALS"}, {"BODY_MIRROR"}},
    {"picture.vert", "resolve_bodies.frag"},
    {"picture.vert", "resolve_bodies.frag", {{"EDGES"}}, kLiquidFront},
    {"picture.vert", "scene_depth.frag"},
    {"picture.vert", "clip_thickness.frag", {{"LIQUID"}}, {}, {"LAYERED"}},
    {"glass.vert", "glass.frag", {{}, {"BEFORE"}}, kLiquidFront},
    {"glass_rim.vert", "glass.frag", {{"RIM"}, {"RIM", "BEFORE"}}, kLiquidFront},
    {"sunlight.vert", "sunlight.frag"},
    {"picture.vert", "sunlight.frag", {{"BODIES"}}},
    {"splats.vert", "splats.frag", kSplatShapes},
    {"large_splats.vert", "splats.frag", kLargeSplatShapes},
    {"splats.vert", "thickness.frag", kSplatShapes},
    {"large_splats.vert", "thickness.frag", kLargeSplatShapes},
    {"splats.vert", "back_splats.frag", kSplatShapes},
    {"large_splats.vert", "back_splats.frag", kLargeSplatShapes},
    {"picture.vert", "invert_depth.frag"},
    {"picture.vert", "mask.frag", {{}, {"BODIES"}, {"LAYERED"}}},
    {"picture.vert", "smooth_thickness.frag"},
    {"picture.vert", "bilateral.frag"},
    {"picture.vert", "binomial.frag"},
    {"picture.vert", "curvature_flow.frag"},
    {"picture.vert", "curvature_flow_vanderlaan2009.frag"},
    {"picture.vert", "full_bilateral.frag"},
    {"picture.vert", "gaussian.frag"},
    {"picture.vert", "narrow_range.frag", {{}}, {"DISC"}},
    {"picture.vert", "plane_fit.frag"},
    {"picture.vert", "rkl_curvature_flow.frag", {{}}, {"RATE"}},
    {"noise.vert", "noise.frag"},
    {"picture.vert", "finish_noise.frag", {{}}, {"VIOLENCE"}},
    {"attributes.vert", "attributes.frag"},
    {"picture.vert", "finish_attributes.frag"},
    {"picture.vert", "study_foam.frag"},
    {"picture.vert", "colour_map.frag", {{}}, {"WHITENING", "LAYERED"}},
    {"picture.vert", "blend_liquid.frag"},
    {"picture.vert",
     "study.frag",
     {{"DEPTH"}, {"VALUES"}, {"NORMALS"}, {"CURVATURE"}, {"LEAST"}, {"GREY"}, {"LIT"}},
     {"LAYERED"}},
    {"spray.vert", "spray.frag", {{}}, kLiquidFront, {"ELLIPSOID"}},
    {"foam.vert", "foam.frag"},
    {"picture.vert", "blend_foam.frag"},
    {"picture.vert", "tone_map.frag", {{"SOFT_CLIP"}, {"FILMIC"}, {"REINHARD"}, {"CLIP"}}},
};

constexpr std::string_view kImplicitFlow = "implicit_curvature_flow.comp";
const Defines kImplicitFlowStages{"RANGE", "CLOSE_GAPS", "LINK", "SOLVE"};

/// A choice with each subset of the flags.
std::vector<Defines> combinationsOf(const Family& family) {
  std::vector<Defines> all;
  for (const Defines& choice : family.choices) {
    for (std::size_t subset = 0; subset < std::size_t{1} << family.flags.size(); ++subset) {
      Defines defines = choice;
      for (std::size_t i = 0; i < family.flags.size(); ++i) {
        if ((subset >> i & 1U) != 0) defines.push_back(family.flags[i]);
      }
      all.push_back(std::move(defines));
    }
  }
  return all;
}

/// Calls `visit` after choosing each member of a oneof of `message` in turn.
template <class Visitor>
void forEachMember(google::protobuf::Message& message, const char* oneof, const Visitor& visit) {
  const google::protobuf::OneofDescriptor& choice = *message.GetDescriptor()->FindOneofByName(oneof);
  for (int i = 0; i < choice.field_count(); ++i) {
    message.GetReflection()->MutableMessage(&message, choice.field(i));
    visit();
  }
}

/// What scenes of every kind of liquid and surroundings lead to.
std::set<CompositeVariant> compositeVariants() {
  std::set<CompositeVariant> variants;
  v1::Scene scene;
  scene::complete(scene);
  v1::Liquid& liquid = *scene.mutable_look()->mutable_liquid();
  const auto addWithNoise = [&] {
    for (const bool layered : {false, true}) {
      CompositeVariant variant = compositeVariant(liquid, scene, layered);
      variants.insert(variant);
      variant.noise = true;
      variants.insert(variant);
      variant.whitening = true;  // is a part of noise
      variants.insert(variant);
    }
  };
  const auto addSurroundings = [&] {
    forEachMember(*scene.mutable_background(), "environment", [&] {
      for (const double sun : {0.0, 1.0}) {
        scene.mutable_lighting()->mutable_sun()->set_strength(sun);
        scene.mutable_background()->set_floor(sun > 0);
        scene.clear_bodies();
        scene.mutable_lighting()->clear_point_lights();
        addWithNoise();
        scene.add_bodies();
        scene::complete(scene);
        addWithNoise();
        scene.mutable_lighting()->add_point_lights();
        scene::complete(scene);
        addWithNoise();
      }
    });
  };
  for (const char* kind : {"clear", "opaque", "glowing", "metal"}) {
    const std::string_view is = kind;
    liquid.set_opaque(is == "opaque" || is == "glowing");
    liquid.mutable_emission()->set_x(is == "glowing" ? 2 : 0);
    if (is == "metal") liquid.mutable_metal();
    forEachMember(liquid, "refraction", [&] {
      forEachMember(liquid, "shading", [&] { forEachMember(liquid, "reflection", addSurroundings); });
    });
  }
  return variants;
}

/// Words of the conditions in a shader and all that it includes.
std::set<std::string> flagsIn(std::string_view shader) {
  std::set<std::string> flags;
  const std::string text = shaders().expand(shader, {}).text;
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = text.find('\n', start);
    const std::string line = text.substr(start, end - start);
    start = end + 1;
    if (!line.starts_with("#if") && !line.starts_with("#elif")) continue;
    std::string word;
    for (const char c : line + ' ') {
      if (std::isupper(static_cast<unsigned char>(c)) != 0 || (c == '_' && !word.empty())) {
        word += c;
      } else if (!word.empty()) {
        flags.insert(std::exchange(word, ""));
      }
    }
  }
  return flags;
}

class ShaderVariants : public ::testing::Test {
 private:
  std::unique_ptr<gl::Context> context_ = gl::Context::create();
};

TEST_F(ShaderVariants, OfEveryPassCompileAndLink) {
  for (const Family& family : kFamilies) {
    for (const Defines& defines : combinationsOf(family)) {
      EXPECT_NO_THROW(shaders().program(family.vertex, family.fragment, defines))
          << family.fragment << ": " << ::testing::PrintToString(defines);
    }
  }
  for (const std::string_view stage : kImplicitFlowStages) {
    EXPECT_NO_THROW(shaders().computeProgram(kImplicitFlow, Defines{stage})) << stage;
  }
}

TEST_F(ShaderVariants, OfTheCompositeCompileAndLink) {
  const std::set<CompositeVariant> variants = compositeVariants();
  // Clear: 3 refractions × 2 shadings; opaque: 2 × with emission or without; metal: 1; each with or without highlight,
  // reflection, and with no, plain or whitening noise.
  EXPECT_GE(variants.size(), (6U + 4U + 1U) * 2U * 2U * 3U);
  for (const CompositeVariant& variant : variants) {
    EXPECT_NO_THROW(shaders().program("picture.vert", "composite.frag", variant.defines()))
        << ::testing::PrintToString(variant.defines());
  }
}

TEST(ShaderFlags, AreAllAskedForBySomePass) {
  std::map<std::string_view, std::set<std::string>> asked;
  for (const Family& family : kFamilies) {
    for (const Defines& defines : combinationsOf(family)) {
      for (const std::string_view shader : {family.vertex, family.fragment}) {
        asked[shader].insert(defines.begin(), defines.end());
        asked[shader].insert(family.idle.begin(), family.idle.end());
      }
    }
  }
  asked[kImplicitFlow].insert(kImplicitFlowStages.begin(), kImplicitFlowStages.end());
  for (const CompositeVariant& variant : compositeVariants()) {
    const Defines defines = variant.defines();
    asked["composite.frag"].insert(defines.begin(), defines.end());
  }
  for (const auto& file : std::filesystem::directory_iterator(SLUICE_SOURCE_FOLDER "/shaders")) {
    const std::string name = file.path().filename().string();
    const std::string kind = file.path().extension().string();
    if (kind != ".vert" && kind != ".frag" && kind != ".comp") continue;
    ASSERT_TRUE(asked.contains(name)) << name;
    for (const std::string& flag : flagsIn(name)) EXPECT_TRUE(asked[name].contains(flag)) << name << ": " << flag;
  }
}

}  // namespace
}  // namespace sluice::render
