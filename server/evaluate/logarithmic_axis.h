#pragma once

#include <limits>
#include <string>
#include <vector>

namespace sluice::evaluate {

/// What an axis shows: values above 0.
struct LogarithmicRange {
  double low = std::numeric_limits<double>::infinity();
  double high = 0;

  void add(double value);
  /// With a margin, and never empty.
  LogarithmicRange padded() const;
  /// Where along the axis a value stands: 0 at `low`, 1 at `high`.
  double share(double value) const;
};

/// Ticks of a logarithmic axis from `low` to `high`, both above 0: powers of ten alone over a long range, 1, 2 and 5
/// times them over a shorter one, and more over a part of one power.
std::vector<double> logarithmicTicks(double low, double high);

/// A tick as people write it: 0.05, 20 k, 2·10⁻⁸.
std::string tickText(double tick);

}  // namespace sluice::evaluate
