#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sluice/app/live_scene.h"
#include "sluice/core/camera.h"

namespace CLI {
class App;
}

namespace sluice::app {

/// What every verb that takes a scene takes.
struct SceneOptions {
  std::string scene;
  std::vector<std::string> assignments;
  std::optional<std::uint64_t> seed;
  int threads = 0;
  bool json = false;

  /// The scene with --set and --seed applied. Throws core::InputError.
  LiveScene load() const;
};

/// Declares SCENE, --set, --seed, --threads and, where the verb prints figures, --json.
void addSceneOptions(CLI::App& verb, SceneOptions& options, const std::string& defaultScene, bool printsFigures);

// Readers of command-line values; throw core::InputError that names the option.

/// "1024x768".
core::ImageSize parseSize(const std::string& text);

/// "x,y,z:x,y,z" or "x,y,z:x,y,z:fov": eye, target and vertical field of view in degrees.
core::Camera parseCamera(const std::string& text, core::Camera fallback);

/// "127.0.0.1:8080" or "[::1]:8080".
struct ListenAddress {
  std::string address;
  std::uint16_t port = 0;
};
ListenAddress parseListenAddress(const std::string& text);

/// "A:B" with 0 ≤ A ≤ B: the frames A to B, both included.
struct FrameRange {
  int first = 0;
  int last = 0;
};
FrameRange parseFrameRange(const std::string& text);

}  // namespace sluice::app
