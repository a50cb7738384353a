#pragma once

#include <vector>

namespace sluice::evaluate {

/// y = fixed + factor·x^exponent.
struct PowerLaw {
  double fixed = 0;
  double factor = 0;
  double exponent = 0;
  double exponentError = 0;  ///< Standard error of the exponent, the fixed part taken as known.

  double at(double x) const;
};

/// Fits positive y over positive x: for every fixed part from 0 to just below the least y, exponent and factor by least
/// squares on the logarithms of x and y − fixed; of these the one whose logarithms of y lie closest. Needs three points
/// of different x; of fewer the exponent is NaN.
PowerLaw fitPowerLaw(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace sluice::evaluate
