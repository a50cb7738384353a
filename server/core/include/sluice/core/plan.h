#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace sluice::core {

/// One stage of a simulation step or one pass of a frame, in the order in which it runs.
struct PlannedStage {
  std::string name;
  std::vector<std::string> reads;
  std::vector<std::string> writes;
  int sweeps = 1;  ///< Times that it goes over all of its data: its work.

  bool operator==(const PlannedStage&) const = default;
};

struct PlannedBuffer {
  std::string name;
  std::uint64_t bytes = 0;

  bool operator==(const PlannedBuffer&) const = default;
};

/// Something that could run and does not, and why: {"thickness", "the liquid is opaque"}.
struct LeftOut {
  std::string name;
  std::string reason;

  bool operator==(const LeftOut&) const = default;
};

/// What a step or a frame does for the scene at hand, for people to read; the typed plans of `sim` and `render`
/// describe themselves as one of these.
struct Plan {
  std::vector<PlannedStage> stages;
  std::vector<PlannedBuffer> buffers;
  std::vector<LeftOut> leftOut;

  bool operator==(const Plan&) const = default;
};

}  // namespace sluice::core
