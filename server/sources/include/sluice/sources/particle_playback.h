#pragma once

#include <memory>
#include <string>

#include "sluice/core/particle_source.h"
#include "sluice/v1/scene.pb.h"

namespace sluice::sources {

/// Plays the particle file or sequence of a complete, valid scene (which must have `particle_file` set). A single file
/// is a source at rest. Throws core::InputError that names the file and what is wrong with it.
std::unique_ptr<core::ParticleSource> openParticlePlayback(const v1::Scene& scene);

/// True when the name looks like a particle file or sequence by its extension (.bgeo, .bgeo.gz, .vtk, .ply, .xyz,
/// .csv).
bool isParticleFile(const std::string& path);

/// A complete scene with sensible defaults for a particle file or sequence: spacing from the median distance to the
/// nearest neighbour, a camera that frames the bounds, a floor below them with tiles to their measure.
v1::Scene sceneForParticleFile(const std::string& path);

}  // namespace sluice::sources
