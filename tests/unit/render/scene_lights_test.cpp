#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "scene_lights.h"
#include "sluice/render/frame_plan.h"
#include "sluice/scene/scene.h"

namespace sluice::render {
namespace {

std::vector<std::string> members(const std::string& file, const std::regex& member) {
  std::ostringstream stream;
  stream << std::ifstream(file).rdbuf();
  std::string text = stream.str();
  text = text.substr(text.find("SceneLights {"));
  text = text.substr(0, text.find("\n}"));
  std::vector<std::string> names;
  for (std::sregex_iterator i(text.begin(), text.end(), member), end; i != end; ++i) names.push_back((*i)[1]);
  return names;
}

TEST(SceneLights, MirrorTheShaders) {
  const std::string root = SLUICE_SOURCE_FOLDER;
  const auto glsl = members(root + "/shaders/scene_lights.glsl", std::regex("\\n  vec4 (\\w+)(?:\\[8\\])?;"));
  const auto cpp =
      members(root + "/server/render/scene_lights.h", std::regex("\\n  (?:Vec4|std::array<Vec4, 8>) (\\w+);"));
  ASSERT_EQ(glsl.size(), 9U);
  EXPECT_EQ(glsl, cpp);
  EXPECT_EQ(sizeof(SceneLights), 16U * (5 + 4 * 8));
}

class BodyPlan : public testing::Test {
 protected:
  BodyPlan() {
    scene::complete(scene);
    traits.points = 1;
  }

  FramePlan plan() const { return planFrame(scene, {64, 48}, std::span(&traits, 1), reuse); }
  v1::Body& add() {
    v1::Body& body = *scene.add_bodies();
    scene::complete(scene);
    return body;
  }

  v1::Scene scene;
  DataTraits traits;
  ReuseTraits reuse;
};

TEST_F(BodyPlan, WithoutBodiesThereIsNothingOfThem) {
  const FramePlan p = plan();
  for (const Pass pass :
       {Pass::BodyShadow, Pass::Bodies, Pass::ClipThickness, Pass::BodyEdges, Pass::GlassBehind, Pass::GlassBefore}) {
    EXPECT_FALSE(p.runs(pass)) << name(pass);
  }
  EXPECT_EQ(p.buffer(Resource::SceneDepth), nullptr);
  EXPECT_EQ(p.buffer(Resource::BodySamples), nullptr);
}

TEST_F(BodyPlan, GlassNeedsNoDepthAndCastsNoShadow) {
  add().mutable_glass();
  scene::complete(scene);
  const FramePlan p = plan();
  EXPECT_TRUE(p.runs(Pass::GlassBehind));
  EXPECT_TRUE(p.runs(Pass::GlassBefore));
  EXPECT_FALSE(p.runs(Pass::Bodies));
  EXPECT_FALSE(p.runs(Pass::BodyShadow));
  EXPECT_EQ(p.buffer(Resource::SceneDepth), nullptr);
}

TEST_F(BodyPlan, WhatStandsStillIsKept) {
  add();
  EXPECT_TRUE(plan().runs(Pass::Bodies));
  EXPECT_TRUE(plan().runs(Pass::BodyShadow));
  reuse.bodies = true;
  EXPECT_TRUE(plan().runs(Pass::Bodies)) << "the camera has moved";
  EXPECT_FALSE(plan().runs(Pass::BodyShadow));
  reuse.background = true;
  EXPECT_FALSE(plan().runs(Pass::Bodies));
  EXPECT_NE(plan().buffer(Resource::SceneDepth), nullptr);
  EXPECT_TRUE(plan().runs(Pass::BodyEdges));
}

TEST_F(BodyPlan, NoSunMeansNoShadow) {
  add();
  scene.mutable_lighting()->mutable_sun()->set_strength(0);
  EXPECT_FALSE(plan().runs(Pass::BodyShadow));
  scene.mutable_lighting()->mutable_sun()->set_strength(1);
  scene.mutable_lighting()->mutable_sun()->set_shadow(0);
  EXPECT_FALSE(plan().runs(Pass::BodyShadow));
}

}  // namespace
}  // namespace sluice::render
