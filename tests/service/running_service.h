#pragma once

#include <cstdint>
#include <string>
#include <thread>
#include <vector>

#include "sluice/app/service.h"
#include "viewer/test_viewer.h"

namespace sluice::test {

/// A few hundred particles that fall: quick to step and to draw. Starts paused, so that pictures change only when a
/// test changes them.
inline constexpr const char* kSmallScene = R"(
  simulation {
    particle_spacing: 0.05
    container { min { x: 0 y: 0 z: 0 } max { x: 1 y: 1 z: 0.5 } }
    fluids { blocks { first_particle { x: 0.05 y: 0.2 z: 0.05 } count_x: 8 count_y: 8 count_z: 9 } }
  }
  camera { eye { x: 1.5 y: 0.9 z: 1.6 } target { x: 0.4 y: 0.3 z: 0.25 } }
  playback { paused: true }
)";

/// A service of its own, on a free port, for as long as it lives.
class RunningService {
 public:
  explicit RunningService(const std::string& sceneText = kSmallScene, stream::ServerOptions options = {},
                          app::SceneRunnerOptions runner = {});
  ~RunningService();

  std::uint16_t port() const { return service_.port(); }

  /// A viewer that has said Hello.
  TestViewer viewer();

 private:
  app::Service service_;
  std::thread thread_;
};

/// RGB of a PNG payload, row by row.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;

  /// The share of pixels that differ in any channel.
  double differingShare(const Picture& other) const;
  /// The number of distinct colours; 1 for a blank picture.
  std::size_t colours() const;
};

Picture decodePng(const std::string& bytes);

v1::Camera cameraAt(double x, double y, double z);

/// An UpdateScene of fields in text format with their mask.
v1::ClientMessage updateMessage(const std::string& sceneText, const std::vector<std::string>& paths);
v1::ClientMessage controlMessage(v1::Control::Action action, double untilSeconds = 0);

/// The value of a metric that the service tells; throws std::runtime_error where it tells none of that name.
double metric(std::uint16_t port, const std::string& name);

}  // namespace sluice::test
