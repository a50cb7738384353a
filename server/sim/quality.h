#pragma once

#include "sluice/v1/scene.pb.h"

namespace sluice::sim {

/// Whether a complete scene's quality is another than `full`.
bool refills(const v1::Scene& scene);

/// Throws core::InputError, as initialState does, where a volume of fluid does not stand clear of the container's faces
/// at the scene's own spacing. To be called before a simulation is refilled, which would leave out what does not.
void checkVolumes(const v1::Simulation& simulation);

/// The simulation of a complete scene at the scene's quality: the same volumes of fluid, filled with about a third of
/// the particles (`draft`), those that the scene names (`full`), or about three times as many (`fine`).
///
/// The spacing changes by the cube root of three (in a planar scene, by its square root), give or take a few percent,
/// and with it everything that is in spacings. Blocks keep their extents, to half a spacing: their faces go to the
/// nearest planes of a lattice that begins one spacing from the lower corner of the box around the container, so that
/// blocks that touch still do, and those that keep their distance from the faces of a box still do. The few percent are
/// chosen so that the blocks of every fluid keep their volume. Balls and meshes are filled from the same lattice; where
/// volumes then meet, or come too near to a face, VolumeFit::Refilled says what is left out. What is allowed or given
/// in numbers of particles changes with their volume. Throws core::InputError where there is no room in the container
/// for a particle of the new spacing; a nozzle may be too small for it, which the simulation refuses.
v1::Simulation atQuality(const v1::Scene& scene);

}  // namespace sluice::sim
