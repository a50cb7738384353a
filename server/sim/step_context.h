#pragma once

#include <string>

#include "boundary.h"
#include "cell_grid.h"
#include "container.h"
#include "discretisation.h"
#include "mixture.h"
#include "neighbour_lists.h"
#include "particles.h"
#include "sluice/core/particle_snapshot.h"
#include "team.h"
#include "walls.h"

namespace sluice::sim {

/// What the stages of one step work on: the simulation's own, for as long as the step lasts.
struct StepContext {
  const Discretisation& discretisation;
  const Container& container;
  const Boundary& boundary;
  const Walls& walls;
  const Mixture& mixture;
  const Team& team;
  const CellGrid& grid;
  NeighbourLists& lists;
  ParticleState& state;
  core::StepStatistics& statistics;

  double seconds = 0;               ///< Length of this step, s.
  double lastSeconds = 0;           ///< Of the last step that was taken; 0 before the first.
  double maxCompression = 1;        ///< ρ/ρ0 - 1 of any particle beyond which the step is taken back.
  bool boundaryInReach = true;      ///< A particle may come within the support radius of a wall.
  double maxSpeed = 0;              ///< max |v| after the move, m/s.
  double pressureAcceleration = 0;  ///< max |a| of an explicit pressure force, m/s².
  std::string trouble;              ///< Why the step cannot be taken, for people; empty while it can.
};

}  // namespace sluice::sim
