#include <fstream>
#include <iterator>

#include "sluice/core/input_error.h"
#include "sluice/scene/scene.h"

namespace sluice::scene {

using core::InputError;

std::vector<FileReference> filesOf(v1::Scene& scene) {
  std::vector<FileReference> files;
  if (scene.has_particle_file()) files.push_back({"particle_file.path", scene.mutable_particle_file()->mutable_path()});
  if (scene.background().has_environment_map()) {
    files.push_back(
        {"background.environment_map.path", scene.mutable_background()->mutable_environment_map()->mutable_path()});
  }
  for (int i = 0; i < scene.bodies_size(); ++i) {
    if (!scene.bodies(i).has_mesh()) continue;
    files.push_back(
        {"bodies[" + std::to_string(i) + "].mesh.path", scene.mutable_bodies(i)->mutable_mesh()->mutable_path()});
  }
  for (int f = 0; f < scene.simulation().fluids_size(); ++f) {
    for (int k = 0; k < scene.simulation().fluids(f).meshes_size(); ++k) {
      files.push_back({"simulation.fluids[" + std::to_string(f) + "].meshes[" + std::to_string(k) + "].path",
                       scene.mutable_simulation()->mutable_fluids(f)->mutable_meshes(k)->mutable_path()});
    }
  }
  return files;
}

v1::Scene load(const std::filesystem::path& file) {
  // A thousand blocks take about 100 kB.
  constexpr std::uintmax_t kLargestFile = 4U << 20U;
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) throw InputError(file.string(), "", "no such file");
  if (!std::filesystem::is_regular_file(status)) throw InputError(file.string(), "", "is not a file");
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error) throw InputError(file.string(), "", "cannot be read: " + error.message());
  if (size > kLargestFile) {
    throw InputError(file.string(), "",
                     "has " + std::to_string(size) + " bytes; a scene has at most " + std::to_string(kLargestFile));
  }
  std::ifstream stream(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream || text.size() < size) throw InputError(file.string(), "", "cannot be read");

  v1::Scene scene = parse(text, file.string());
  for (const FileReference& reference : filesOf(scene)) {
    // An absolute path on the right replaces the folder.
    *reference.path = (file.parent_path() / *reference.path).lexically_normal().string();
  }
  return scene;
}

}  // namespace sluice::scene
