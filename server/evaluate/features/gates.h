#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sluice::evaluate {

/// What changes from frame to frame, and what there is.
struct Motion {
  bool camera = false;
  bool particles = false;   ///< Their positions are the same, but count as new, and they are shaken.
  bool bodies = false;      ///< They stand a little farther on in every frame.
  bool twoLiquids = false;  ///< The column is of a second liquid.
};

/// One thing that a frame may do without. Assignments as with --set, several with a blank between.
struct Gate {
  std::string_view feature;
  std::string_view inUse;
  std::string_view leftOut;
  Motion motionInUse;
  Motion motionLeftOut;
  std::string_view both = {};  ///< Assignments of both sides.
};

std::span<const Gate> gates();

/// Such assignments one by one.
std::vector<std::string> assignmentsOf(std::string_view assignments);

}  // namespace sluice::evaluate
