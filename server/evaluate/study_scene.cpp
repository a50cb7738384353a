#include "study_scene.h"

#include "sluice/scene/scene.h"

namespace sluice::evaluate {

v1::Scene studyScene(const Options& options, std::string_view text) {
  v1::Scene scene = scene::parse(text, "the study's scene");
  scene::assign(scene, options.assignments);
  return scene;
}

v1::Scene shippedScene(const Options& options, std::string_view name) {
  v1::Scene scene = scene::loadShipped(name);
  scene::assign(scene, options.assignments);
  return scene;
}

}  // namespace sluice::evaluate
