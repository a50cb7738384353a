#include "sluice/app/live_scene.h"

#include <cstdio>

#include "sluice/core/input_error.h"
#include "sluice/scene/scene.h"
#include "sluice/sim/simulation.h"
#include "sluice/sources/column_and_sheet.h"
#include "sluice/sources/foam_source.h"
#include "sluice/sources/particle_playback.h"

namespace sluice::app {

namespace {

std::unique_ptr<core::ParticleSource> openLiquid(const v1::Scene& scene, int threads, std::uint64_t mostParticles) {
  switch (scene.source_case()) {
    case v1::Scene::kSimulation:
      return sim::makeSimulation(scene, threads, mostParticles);
    case v1::Scene::kParticleFile:
      return sources::openParticlePlayback(scene);
    case v1::Scene::kColumnAndSheet:
      return sources::openColumnAndSheet(scene);
    default:
      throw core::InputError("", "source", "the scene has no source of particles");
  }
}

}  // namespace

LiveScene loadScene(const std::string& nameOrPath, const std::vector<std::string>& assignments) {
  LiveScene live;
  if (scene::isShipped(nameOrPath)) {
    live.name = nameOrPath;
    live.scene = scene::loadShipped(nameOrPath);
  } else if (sources::isParticleFile(nameOrPath)) {
    live.scene = sources::sceneForParticleFile(nameOrPath);
  } else if (nameOrPath.ends_with(".textproto")) {
    live.scene = scene::load(nameOrPath);
  } else {
    std::string names;
    for (const scene::ShippedScene& shipped : scene::shippedScenes()) {
      names += (names.empty() ? "" : ", ") + shipped.name;
    }
    throw core::InputError(nameOrPath, "",
                           "is neither a shipped scene (" + names +
                               "), nor a .textproto, nor a particle file (.bgeo, .bgeo.gz, .vtk, .ply, .xyz, .csv)");
  }
  if (!assignments.empty()) scene::assign(live.scene, assignments);
  return live;
}

std::unique_ptr<core::ParticleSource> openSource(const v1::Scene& scene, int threads, std::uint64_t mostParticles) {
  // Whether or not the scene has foam: a viewer may switch it on while the source runs.
  std::unique_ptr<core::ParticleSource> source =
      sources::withFoam(openLiquid(scene, threads, mostParticles), scene, threads);
  for (const std::string& notice : source->notices()) std::fprintf(stderr, "sluice-server: %s\n", notice.c_str());
  return source;
}

}  // namespace sluice::app
