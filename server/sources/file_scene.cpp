#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "frame_files.h"
#include "nearest_neighbours.h"
#include "sluice/core/camera.h"
#include "sluice/core/input_error.h"
#include "sluice/particleio/particle_file.h"
#include "sluice/scene/convert.h"
#include "sluice/scene/scene.h"
#include "sluice/sources/particle_playback.h"

namespace sluice::sources {

namespace {

namespace fs = std::filesystem;

/// Coordinates that a scene's floor and cameras can follow, m.
constexpr float kFarthest = 1e4F;

struct Extent {
  Eigen::AlignedBox3f bounds;
  double spacing = 0;
};

/// Over the first, middle and last frame, so that the camera sees where the liquid goes.
Extent measure(const std::vector<fs::path>& files) {
  std::vector<std::size_t> frames{0, files.size() / 2, files.size() - 1};
  frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
  Extent extent;
  for (const std::size_t frame : frames) {
    const particleio::ParticleFileData particles = particleio::readParticleFile(files[frame]);
    for (const Eigen::Vector3f& position : particles.positions) extent.bounds.extend(position);
    if (extent.spacing == 0) extent.spacing = medianNearestNeighbourDistance(particles.positions);
  }
  // A file without particles is shown as an empty room.
  if (extent.bounds.isEmpty())
    extent.bounds = Eigen::AlignedBox3f(Eigen::Vector3f(-1, 0, -1), Eigen::Vector3f(1, 1, 1));
  return extent;
}

void refuseFarParticles(const Eigen::AlignedBox3f& bounds, const std::string& path) {
  if (bounds.min().minCoeff() >= -kFarthest && bounds.max().maxCoeff() <= kFarthest) return;
  const Eigen::IOFormat inBrackets(Eigen::StreamPrecision, Eigen::DontAlignCols, ", ", ", ", "", "", "(", ")");
  std::ostringstream text;
  text << "the particles reach from " << bounds.min().transpose().format(inBrackets) << " to "
       << bounds.max().transpose().format(inBrackets) << "; allowed are coordinates within [-10000, 10000] m";
  throw core::InputError(path, "", text.str());
}

/// The nearest of 1, 2, 5, 10, 20, 50, … below.
double roundTile(double size) {
  const double power = std::pow(10.0, std::floor(std::log10(size)));
  const double digit = size / power;
  return power * (digit >= 5 ? 5 : digit >= 2 ? 2 : 1);
}

}  // namespace

bool isParticleFile(const std::string& path) { return particleio::formatOf(path).has_value(); }

v1::Scene sceneForParticleFile(const std::string& path) {
  const std::vector<fs::path> files = frameFiles(path);
  const Extent extent = measure(files);
  refuseFarParticles(extent.bounds, path);

  v1::Scene scene;
  scene.set_title(fs::path(path).filename().string());
  scene.set_description(files.size() == 1 ? "A particle file"
                                          : "A sequence of " + std::to_string(files.size()) + " files");
  v1::ParticleFile& file = *scene.mutable_particle_file();
  file.set_path(path);
  // Beyond 10 m, which no slider goes to, and below what can be measured the playback finds its own.
  if (extent.spacing <= 10) file.set_particle_spacing(extent.spacing);

  const Eigen::Vector3f size = extent.bounds.sizes();
  const double widest = std::clamp<double>(std::max(size.x(), size.z()), 1e-2, 1e4);
  v1::Background& background = *scene.mutable_background();
  // A spacing below the lowest centre, clear of splats of 0.9 spacings.
  background.set_floor_height(std::max<double>(extent.bounds.min().y() - extent.spacing, -kFarthest));
  constexpr double kTilesAcross = 8;
  background.set_tile_size(std::clamp(roundTile(widest / kTilesAcross), 1e-3, 1e3));
  // The proportion of the defaults: a scene 2.4 m across and 12 m of haze.
  background.set_haze_distance(5 * widest);
  // A margin about the bounds: the splats of the outermost particles, and the corners, stay in the picture.
  const Eigen::Vector3f margin = size / 18 + Eigen::Vector3f::Constant(static_cast<float>(extent.spacing));
  *scene.mutable_camera() =
      scene::fromCamera(core::framingCamera(extent.bounds.min() - margin, extent.bounds.max() + margin));

  scene::complete(scene);
  scene::validate(scene);
  return scene;
}

}  // namespace sluice::sources
