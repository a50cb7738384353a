#include <cmath>
#include <limits>
#include <set>

#include <gtest/gtest.h>

#include "stability/camera_cases.h"
#include "stability/depth_cases.h"
#include "stability/smoothing_stability.h"

namespace sluice::evaluate {
namespace {

render::FloatPicture picture(std::vector<float> values) {
  return {{static_cast<int>(values.size()), 1}, std::move(values)};
}

TEST(StabilityCases, DepthImagesAreFiniteAndNamedApart) {
  std::set<std::string> names;
  for (const DepthCase& depthCase : depthCases()) {
    EXPECT_TRUE(names.insert(depthCase.name).second) << depthCase.name;
    EXPECT_EQ(depthCase.surface.values.size(), 128U * 128U);
    for (const float q : depthCase.surface.values) {
      ASSERT_TRUE(std::isfinite(q) && q >= 0) << depthCase.name;
    }
  }
  EXPECT_GE(names.size(), 15U);
}

TEST(StabilityCases, CamerasAreNamedApartAndParticlesFinite) {
  std::set<std::string> names;
  for (const CameraCase& cameraCase : cameraCases()) {
    EXPECT_TRUE(names.insert(cameraCase.name).second) << cameraCase.name;
    EXPECT_GT(cameraCase.particles.size(), 0U) << cameraCase.name;
    for (const Eigen::Vector3f& p : cameraCase.particles.positions) ASSERT_TRUE(p.allFinite()) << cameraCase.name;
  }
}

TEST(StabilityOutcome, SameIsBounded) {
  const Outcome outcome = judgeSmoothed(picture({0, 0.25F, 0.5F}), picture({0, 0.3F, 0.4F}));
  EXPECT_TRUE(outcome.passed);
  EXPECT_EQ(outcome.largest, 1);
}

TEST(StabilityOutcome, LeavingTheRangeIsMeasured) {
  const Outcome above = judgeSmoothed(picture({0.25F, 0.5F}), picture({0.25F, 1.5F}));
  EXPECT_FALSE(above.passed);
  EXPECT_NEAR(above.largest, 3, 1e-6);
  const Outcome below = judgeSmoothed(picture({0.25F, 0.5F}), picture({0.05F, 0.5F}));
  EXPECT_FALSE(below.passed);
  EXPECT_NEAR(below.largest, 5, 1e-6);
}

TEST(StabilityOutcome, WhatIsNoDepthFails) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinite = std::numeric_limits<float>::infinity();
  for (const float bad : {nan, infinite, -infinite, -0.1F}) {
    EXPECT_FALSE(judgeSmoothed(picture({0.25F, 0.25F}), picture({0.25F, bad})).passed) << bad;
    EXPECT_FALSE(judgeSmoothed(picture({0.25F, 0}), picture({0.25F, bad})).passed) << bad;
  }
  EXPECT_FALSE(judgeSmoothed(picture({0.25F, 0}), picture({0.25F, 0.25F})).passed) << "liquid out of nothing";
  EXPECT_TRUE(judgeSmoothed(picture({0.25F, 0.25F}), picture({0.25F, 0})).passed) << "a pixel may be left out";
}

}  // namespace
}  // namespace sluice::evaluate
