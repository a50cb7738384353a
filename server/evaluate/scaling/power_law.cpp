#include "scaling/power_law.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sluice/core/check.h"

namespace sluice::evaluate {

namespace {

/// The straight line through the logarithms of x and y − fixed.
PowerLaw fitLine(const std::vector<double>& x, const std::vector<double>& y, double fixed) {
  const auto n = static_cast<double>(x.size());
  double meanX = 0;
  double meanY = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    meanX += std::log(x[i]) / n;
    meanY += std::log(y[i] - fixed) / n;
  }
  double xx = 0;
  double xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double dx = std::log(x[i]) - meanX;
    xx += dx * dx;
    xy += dx * (std::log(y[i] - fixed) - meanY);
  }
  PowerLaw law;
  law.fixed = fixed;
  law.exponent = xy / xx;
  law.factor = std::exp(meanY - law.exponent * meanX);
  double residual = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double r = std::log(y[i] - fixed) - std::log(law.factor) - law.exponent * std::log(x[i]);
    residual += r * r;
  }
  law.exponentError = n > 2 ? std::sqrt(residual / (n - 2) / xx) : 0;
  return law;
}

double squaredMisfit(const PowerLaw& law, const std::vector<double>& x, const std::vector<double>& y) {
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double r = std::log(y[i] / law.at(x[i]));
    sum += r * r;
  }
  return sum;
}

}  // namespace

double PowerLaw::at(double x) const { return fixed + factor * std::pow(x, exponent); }

PowerLaw fitPowerLaw(const std::vector<double>& x, const std::vector<double>& y) {
  SLUICE_CHECK_EQ(x.size(), y.size());
  PowerLaw best;
  best.exponent = std::numeric_limits<double>::quiet_NaN();
  if (x.size() < 3) return best;
  const double least = *std::ranges::min_element(y);
  double bestMisfit = std::numeric_limits<double>::infinity();
  constexpr int kTrials = 400;  // a fixed part is found to a quarter per cent of the least y
  for (int i = 0; i < kTrials; ++i) {
    const PowerLaw law = fitLine(x, y, least * i / kTrials);
    const double misfit = squaredMisfit(law, x, y);
    if (misfit < bestMisfit) {
      bestMisfit = misfit;
      best = law;
    }
  }
  return best;
}

}  // namespace sluice::evaluate
