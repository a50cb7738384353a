#pragma once

#include "sluice/v1/scene.pb.h"

namespace sluice::sim {

/// The simulation of a complete scene at the scene's quality: the same volumes of fluid, filled with a third of the
/// particles (`draft`), those that the scene names (`full`), or three times as many (`fine`).
///
/// The spacing changes by the cube root of three (in a planar scene, by its square root), and with it everything that
/// is in spacings. Blocks keep their extents, to half a spacing: their faces go to the nearest planes of a lattice that
/// begins one spacing from the container's lower corner, so that blocks that touch still do, and those that keep their
/// distance from the container's faces still do. What is allowed or given in numbers of particles changes with their
/// volume. Throws core::InputError where there is no room in the container for a particle of the new spacing.
v1::Simulation atQuality(const v1::Scene& scene);

}  // namespace sluice::sim
