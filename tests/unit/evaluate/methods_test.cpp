#include "smoothing/methods.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "smoothing/shape_rows.h"

namespace sluice::evaluate {
namespace {

TEST(SmoothingMethods, AreThoseOfTheSchema) {
  const auto* const oneof = v1::Smoothing::descriptor()->FindOneofByName("method");
  const std::vector<SmoothingMethod> methods = smoothingMethods();
  EXPECT_EQ(static_cast<int>(methods.size()), oneof->field_count());
  EXPECT_EQ(std::ranges::count(methods, true, &SmoothingMethod::isDefault), 1);
}

TEST(SmoothingMethods, EachCanBeChosenWithItsDefaults) {
  for (const SmoothingMethod& method : smoothingMethods()) {
    v1::Smoothing smoothing;
    chooseMethod(smoothing, method.name);
    EXPECT_EQ(chosenMethod(smoothing).GetDescriptor(),
              v1::Smoothing::descriptor()->FindFieldByName(method.name)->message_type());
  }
  v1::Smoothing smoothing;
  chooseMethod(smoothing, "curvature_flow");
  EXPECT_TRUE(smoothing.curvature_flow().has_step_fraction());
}

TEST(SmoothingMethods, ChoosingTheChosenKeepsItsFields) {
  v1::Smoothing smoothing;
  smoothing.mutable_bilateral()->set_iterations(5);
  chooseMethod(smoothing, "bilateral");
  EXPECT_EQ(smoothing.bilateral().iterations(), 5U);
}

TEST(SmoothingMethods, FieldsAreSetBeyondTheirRange) {
  v1::CurvatureFlow flow;
  EXPECT_TRUE(setField(flow, "step_fraction", 1.05));
  EXPECT_EQ(flow.step_fraction(), 1.05);
  EXPECT_TRUE(setField(flow, "max_iterations", 12));
  EXPECT_EQ(flow.max_iterations(), 12U);
  EXPECT_FALSE(setField(flow, "no_such_field", 1));
  EXPECT_EQ(largestAllowed(flow, "max_iterations"), 10'000);
  EXPECT_EQ(largestAllowed(flow, "no_such_field"), 0);
}

TEST(SmoothingMethods, StagesAreNamedInWords) {
  EXPECT_EQ((SmoothingMethod{"narrow_range", false}).stage(), "narrow range");
}

TEST(SmoothingSweep, HoldsTheDefaults) {
  for (const bool quick : {false, true}) {
    const Sweep sweep = smoothingSweep(quick);
    EXPECT_EQ(std::ranges::count(sweep.strengths, defaultSmoothingTime()), 1);
    EXPECT_EQ(std::ranges::count(sweep.divisors, defaultSmoothingDivisor()), 1);
    EXPECT_TRUE(std::ranges::is_sorted(sweep.strengths));
  }
  EXPECT_LT(smoothingSweep(true).strengths.size(), smoothingSweep(false).strengths.size());
}

}  // namespace
}  // namespace sluice::evaluate
