#include "scaling/power_law.h"

#include <cmath>

#include <gtest/gtest.h>

namespace sluice::evaluate {
namespace {

const std::vector<double> kX{4e3, 8e3, 16e3, 32e3, 64e3, 128e3, 256e3};

std::vector<double> valuesOf(double fixed, double factor, double exponent) {
  std::vector<double> y;
  for (const double x : kX) y.push_back(fixed + factor * std::pow(x, exponent));
  return y;
}

TEST(PowerLaw, FindsWhatItWasMadeOf) {
  for (const double exponent : {0.5, 1.0, 1.5}) {
    const PowerLaw law = fitPowerLaw(kX, valuesOf(0, 1e-4, exponent));
    EXPECT_NEAR(law.exponent, exponent, 1e-6);
    EXPECT_NEAR(law.fixed, 0, 1e-9);
    EXPECT_NEAR(law.exponentError, 0, 1e-6);
  }
}

TEST(PowerLaw, SeparatesTheFixedPart) {
  const PowerLaw law = fitPowerLaw(kX, valuesOf(12, 2e-4, 1));
  EXPECT_NEAR(law.exponent, 1, 0.02);
  EXPECT_NEAR(law.fixed, 12, 0.1);
  EXPECT_NEAR(law.at(64e3), 12 + 2e-4 * 64e3, 0.05);
}

TEST(PowerLaw, BearsNoise) {
  std::vector<double> y = valuesOf(5, 1e-3, 1);
  for (std::size_t i = 0; i < y.size(); ++i) y[i] *= 1 + 0.03 * std::sin(7.0 * static_cast<double>(i));
  const PowerLaw law = fitPowerLaw(kX, y);
  EXPECT_NEAR(law.exponent, 1, 0.12);
  EXPECT_GT(law.exponentError, 0);
}

TEST(PowerLaw, NeedsThreePoints) { EXPECT_TRUE(std::isnan(fitPowerLaw({1, 2}, {1, 2}).exponent)); }

}  // namespace
}  // namespace sluice::evaluate
