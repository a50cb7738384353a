#pragma once

#include <limits>
#include <string_view>

#include "sluice/v1/scene.pb.h"

namespace sluice::sim {

/// What bounds the length of the next step.
struct TimeStepInputs {
  double spacing = 0;    ///< d, m.
  double support = 0;    ///< H, m.
  double maxSpeed = 0;   ///< max |v|, m/s.
  double gravity = 0;    ///< |g|, m/s².
  double viscosity = 0;  ///< ν of the explicit viscosity stage, m²/s; 0 where it does not run.
  /// Bound left by a step that had to be taken back, s.
  double recovery = std::numeric_limits<double>::infinity();
};

struct TimeStepChoice {
  double seconds = 0;
  std::string_view limit;  ///< "max_seconds", "cfl", "gravity", "viscosity" or "recovery".
};

/// The smallest of the bounds that apply; `min_seconds` is for the caller to hold against it.
TimeStepChoice chooseTimeStep(const v1::TimeStep& settings, const TimeStepInputs& inputs);

}  // namespace sluice::sim
