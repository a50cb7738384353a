#pragma once

#include <vector>

#include "cell_grid.h"
#include "particles.h"
#include "sluice/core/state_stream.h"
#include "team.h"

namespace sluice::sim {

/// Tells for how long particles none of which has a neighbour will stay without one: while the gap left between the
/// closest two is wider than what they can have closed since it was measured.
class FreeFlight {
 public:
  /// Nothing is known yet.
  void reset() { *this = {}; }

  /// After a search for neighbours that found some.
  void noteNeighbours() { reset(); }

  /// After a search for neighbours that found none within `support`. The gap is measured from the second such search
  /// in a row on, when pressures have gone back to 0.
  void noteNone(const CellGrid& grid, const std::vector<Float4>& positions, double support, const Team& team);

  void save(core::StateWriter& out) const;
  void resume(core::StateReader& in);

  /// Whether no two particles can come within the support by moving for `seconds` under a common acceleration.
  bool covers(const std::vector<Float4>& velocities, double seconds, const Team& team) const;

  /// After such a move, with the velocities after it.
  void advance(const std::vector<Float4>& velocities, double seconds, const Team& team);

 private:
  bool noneBefore_ = false;
  double gap_ = 0;  ///< m.
};

}  // namespace sluice::sim
