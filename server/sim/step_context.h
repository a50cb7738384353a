#pragma once

#include <string>

#include "body_contacts.h"
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

/// The bodies that move, and what touches them.
struct BodyStep {
  MovingBodies& bodies;
  MovingBoundary& boundary;
  BodyContacts& contacts;
  BodyCoupling coupling;
};

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
  BodyStep* bodies = nullptr;  ///< Null where no body moves.

  double seconds = 0;               ///< Length of this step, s.
  double lastSeconds = 0;           ///< Of the last step that was taken; 0 before the first.
  double maxCompression = 1;        ///< ρ/ρ0 - 1 of any particle beyond which the step is taken back.
  bool boundaryInReach = true;      ///< A particle may come within the support radius of a wall.
  double maxSpeed = 0;              ///< max |v| after the move, m/s.
  double pressureAcceleration = 0;  ///< max |a| of an explicit pressure force, m/s².
  bool bodiesInReach = false;       ///< A particle may come within the support radius of a body that moves.
  std::string trouble;              ///< Why the step cannot be taken, for people; empty while it can.

  /// What takes part in a solve for pressure; null where no moving body is near.
  BodyCoupling* coupling() const {
    return bodies != nullptr && !bodies->coupling.isIdle() ? &bodies->coupling : nullptr;
  }

  /// Adds what moving bodies have to the sums of pairs that have just been found.
  void findContacts() {
    if (bodies == nullptr) return;
    if (!bodiesInReach) return bodies->contacts.clear();
    bodies->contacts.find(bodies->boundary, bodies->bodies, grid, state.position, lists, team);
  }
};

}  // namespace sluice::sim
