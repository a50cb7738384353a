#pragma once

#include "sluice/sim/experiment.h"
#include "sluice/v1/scene.pb.h"
#include "solvers/measures.h"

namespace sluice::evaluate {

/// A rectangle of the plane, m.
struct Rectangle {
  double left = 0, bottom = 0, right = 1, top = 1;
};

/// A planar scene without gravity, viscosity and particles of its own.
v1::Simulation planarScene(double spacing, const Rectangle& container);

/// The kernel for accuracy: Wendland C2 over this many spacings.
void useWendland(v1::Simulation& simulation, double supportInSpacings);

/// For the weakly compressible solvers, which take no notice of forces other than gravity: the speed of sound. The
/// other solvers of a sweep replace it.
void setSpeedOfSound(v1::Simulation& simulation, double metresPerSecond, bool negativePressure);

/// Columns × rows of particles, the first half a spacing or one spacing (`clearance`) from the left and the bottom.
std::vector<Eigen::Vector3d> block(double spacing, double clearance, int columns, int rows);

}  // namespace sluice::evaluate
