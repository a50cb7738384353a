#pragma once

#include <string>

#include "sluice/core/frame.h"

namespace sluice::testing {

/// How much a picture may differ from its golden: rounding differs a little between drivers.
struct Tolerance {
  int perChannel = 4;              ///< Differences up to this, of 255, do not count.
  double failingFraction = 0.002;  ///< Share of pixels that may differ by more.
};

/// Compares with tests/golden/<name>.png. A failure leaves <name>_actual.png and <name>_diff.png (differences eight
/// times enlarged) in the build folder and returns what differs; empty means equal enough. With the environment
/// variable UPDATE=1 it writes the golden instead. A golden is made once the picture has been looked at.
std::string compareWithGolden(const std::string& name, const core::Frame& actual, Tolerance tolerance = {});

}  // namespace sluice::testing
