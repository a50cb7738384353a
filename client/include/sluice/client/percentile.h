#pragma once

#include <vector>

namespace sluice::client {

/// The value below which the fraction 0 ≤ `fraction` ≤ 1 of the samples lies, interpolated linearly between the two
/// nearest (definition 7 of Hyndman & Fan 1996). NaN where there is no sample.
double percentile(std::vector<double> samples, double fraction);

inline double median(std::vector<double> samples) { return percentile(std::move(samples), 0.5); }

}  // namespace sluice::client
