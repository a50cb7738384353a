#include "turning_view.h"

#include <numbers>

#include <Eigen/Geometry>

#include "sluice/gl/context.h"
#include "sluice/render/fluid_renderer.h"
#include "sluice/scene/convert.h"
#include "sluice/scene/scene.h"
#include "sluice/sim/simulation.h"
#include "sluice/sources/foam_source.h"

namespace sluice::bench {

std::vector<core::Frame> turningView(int frames) {
  constexpr double kStart = 0.6;  // s; the front of the water is about to reach the far wall.
  constexpr double kFramesPerSecond = 25;
  const Eigen::AngleAxisf turn(0.4F * std::numbers::pi_v<float> / 180.0F, Eigen::Vector3f::UnitY());

  const v1::Scene scene = scene::loadShipped("dam_break");
  const auto source = sources::withFoam(sim::makeSimulation(scene), scene);
  const std::unique_ptr<gl::Context> context = gl::Context::create();
  render::FluidRenderer renderer(*context);
  core::Camera camera = scene::toCamera(scene.camera());
  std::vector<core::Frame> pictures;
  for (int k = 0; k < frames; ++k) {
    const double time = kStart + k / kFramesPerSecond;
    source->stopAt(time);
    while (source->time() < time && source->advance()) {
    }
    const auto particles = source->snapshot();
    particles->sequence = static_cast<std::uint64_t>(k) + 1;
    pictures.push_back(renderer.render(*particles, scene, camera, {1280, 720}));
    camera.eye = camera.target + turn * (camera.eye - camera.target);
  }
  return pictures;
}

}  // namespace sluice::bench
