#pragma once

#include <string>
#include <vector>

#include "shapes/surface.h"
#include "sluice/core/camera.h"
#include "sluice/core/particle_snapshot.h"
#include "sluice/evaluate/report.h"
#include "sluice/evaluate/study.h"
#include "sluice/render/fluid_renderer.h"

namespace sluice::evaluate {

/// A cloud of particles and the surface that pictures of it should show.
struct Subject {
  std::string name;
  core::ParticleSnapshot particles;
  const Surface* surface = nullptr;
  core::Camera camera;
};

/// What is varied, beside the method.
struct Sweep {
  core::ImageSize size;
  std::vector<double> strengths;  ///< T, d²; ascending.
  std::vector<int> divisors;
  double longestMilliseconds = 0;  ///< A case whose frames take longer is left out, with a note.
};

/// Fewer cases for a quick run; always with the schema's defaults among them.
Sweep smoothingSweep(bool quick);

/// A row for every method, strength and resolution, and one per resolution for raw splats ("none"). Adds to `notes`
/// what was left out.
std::vector<Row> smoothingRows(render::FluidRenderer& renderer, const Subject& subject, const Sweep& sweep,
                               const Options& options, std::vector<std::string>& notes);

}  // namespace sluice::evaluate
