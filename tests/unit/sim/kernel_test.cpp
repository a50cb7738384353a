#include "kernel.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "lattice.h"

namespace sluice::sim {
namespace {

template <class Kernel>
class KernelTest : public testing::Test {};

using Kernels = testing::Types<CubicSpline, WendlandC2>;
TYPED_TEST_SUITE(KernelTest, Kernels);

constexpr double kSupport = 0.13;

TYPED_TEST(KernelTest, IntegratesToOneInTwoAndThreeDimensions) {
  constexpr int kShells = 20000;
  const double width = kSupport / kShells;
  double inSpace = 0;
  double inPlane = 0;
  for (int i = 0; i < kShells; ++i) {
    const double r = (i + 0.5) * width;
    inSpace += 4 * std::numbers::pi * r * r * kernelValue<TypeParam>(r, kSupport, 3) * width;
    inPlane += 2 * std::numbers::pi * r * kernelValue<TypeParam>(r, kSupport, 2) * width;
  }
  EXPECT_NEAR(inSpace, 1, 1e-7);
  EXPECT_NEAR(inPlane, 1, 1e-7);
}

TYPED_TEST(KernelTest, SlopeIsTheDerivative) {
  const double step = 1e-6 * kSupport;
  for (const int dimensions : {2, 3}) {
    for (double q = 0.01; q < 1.1; q += 0.0173) {
      const double r = q * kSupport;
      const double numerical = (kernelValue<TypeParam>(r + step, kSupport, dimensions) -
                                kernelValue<TypeParam>(r - step, kSupport, dimensions)) /
                               (2 * step);
      const double scale = TypeParam::normalisation(dimensions) / std::pow(kSupport, dimensions + 1);
      EXPECT_NEAR(kernelSlope<TypeParam>(r, kSupport, dimensions), numerical, 1e-5 * scale) << "q = " << q;
    }
  }
}

TYPED_TEST(KernelTest, VanishesFromTheSupportOn) {
  for (const float q : {1.0F, 1.5F, 1e18F}) {
    EXPECT_EQ(TypeParam::value(q), 0.0F);
    EXPECT_EQ(TypeParam::slope(q), 0.0F);
  }
}

TYPED_TEST(KernelTest, SteepestSlopeIsTheLargestOne) {
  double steepest = 0;
  for (double q = 0; q < 1; q += 1e-4) steepest = std::max(steepest, std::abs(TypeParam::slope(q)));
  EXPECT_NEAR(steepest, TypeParam::kSteepestSlope, 1e-6);
}

TEST(CubicSpline, HasMonaghansBranches) {
  for (double q = 0; q <= 0.5; q += 0.05) EXPECT_NEAR(CubicSpline::value(q), 6 * (q * q * q - q * q) + 1, 1e-12);
  for (double q = 0.5; q <= 1; q += 0.05) EXPECT_NEAR(CubicSpline::value(q), 2 * std::pow(1 - q, 3), 1e-12);
}

// Reference figures: lattice sums computed independently, to four digits.
TEST(Lattice, DensityOfTheCubicSplineMatchesTheTable) {
  EXPECT_NEAR(latticeDensity(KernelKind::CubicSpline, 1, 2.0), 1.0000, 1e-4);
  EXPECT_NEAR(latticeDensity(KernelKind::CubicSpline, 1, 2.6), 0.9973, 1e-4);
  EXPECT_NEAR(latticeDensity(KernelKind::CubicSpline, 1, 3.0), 1.0018, 1e-4);
  EXPECT_NEAR(latticeDensity(KernelKind::CubicSpline, 1, 4.0), 1.0001, 1e-4);
}

TEST(Lattice, DensitiesOfTheWendlandKernelAndOfThePlaneMatchTheTable) {
  EXPECT_NEAR(latticeDensity(KernelKind::WendlandC2, 1, 2.0), 1.0338, 1e-4);
  EXPECT_NEAR(latticeDensity(KernelKind::WendlandC2, 1, 3.0), 1.0031, 1e-4);
  EXPECT_NEAR(latticeDensity(KernelKind::CubicSpline, 1, 2.0, 2), 1.0009, 1e-4);
  EXPECT_NEAR(latticeDensity(KernelKind::CubicSpline, 1, 3.0, 2), 1.0034, 1e-4);
  EXPECT_NEAR(latticeDensity(KernelKind::WendlandC2, 1, 2.0, 2), 1.0376, 1e-4);
  EXPECT_NEAR(latticeDensity(KernelKind::WendlandC2, 1, 4.0, 2), 1.0012, 1e-4);
}

// Reference figures: the eigenvalues computed independently, over a finer set of waves.
TEST(Lattice, PressureGetsStifferWithTheNumberOfNeighbours) {
  EXPECT_NEAR(pressureStiffness(KernelKind::CubicSpline, 0.1, 0.20), 2.82, 0.02);
  EXPECT_NEAR(pressureStiffness(KernelKind::CubicSpline, 0.1, 0.30), 7.47, 0.05);
  EXPECT_NEAR(pressureStiffness(KernelKind::WendlandC2, 1, 4), 14.31, 0.1);
  EXPECT_NEAR(pressureStiffness(KernelKind::CubicSpline, 1, 2, 2), 2.15, 0.02);
}

TEST(Lattice, HalfSpaceLacksItsOtherHalf) {
  EXPECT_NEAR(halfSpaceDensity(KernelKind::CubicSpline, 0.05, 0.10), 0.850, 1e-3);
  EXPECT_NEAR(halfSpaceDensity(KernelKind::CubicSpline, 0.05, 0.15), 0.734, 1e-3);
}

}  // namespace
}  // namespace sluice::sim
