#include <algorithm>

#include "names.h"
#include "shipped_scenes.h"
#include "sluice/core/check.h"
#include "sluice/core/input_error.h"
#include "sluice/scene/scene.h"

namespace sluice::scene {

namespace {

constexpr std::string_view kExtension = ".textproto";

std::string nameOf(const EmbeddedFile& file) {
  SLUICE_CHECK(file.name.ends_with(kExtension));
  return std::string(file.name.substr(0, file.name.size() - kExtension.size()));
}

}  // namespace

const std::vector<ShippedScene>& shippedScenes() {
  static const std::vector<ShippedScene> kScenes = [] {
    std::vector<ShippedScene> scenes;
    for (const EmbeddedFile& file : embeddedFiles()) {
      const v1::Scene scene = parse(file.text, std::string(file.name));
      scenes.push_back({nameOf(file), scene.title(), scene.description()});
    }
    std::sort(scenes.begin(), scenes.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
    return scenes;
  }();
  return kScenes;
}

bool isShipped(std::string_view name) {
  const auto& scenes = shippedScenes();
  return std::any_of(scenes.begin(), scenes.end(), [&](const ShippedScene& scene) { return scene.name == name; });
}

v1::Scene loadShipped(std::string_view name) {
  for (const EmbeddedFile& file : embeddedFiles()) {
    if (nameOf(file) == name) return parse(file.text, std::string(file.name));
  }
  std::vector<std::string> names;
  for (const ShippedScene& scene : shippedScenes()) names.push_back(scene.name);
  throw core::InputError("", "", "no shipped scene is called " + inQuotes(name) + "; " + suggestNames(name, names));
}

}  // namespace sluice::scene
