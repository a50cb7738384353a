#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sluice/core/camera.h"
#include "sluice/core/frame.h"
#include "sluice/core/interaction.h"
#include "sluice/stream/metrics_text.h"
#include "sluice/v1/session.pb.h"

namespace sluice::stream {

/// How a viewer wants its stream; checked against the limits.
struct View {
  core::ImageSize size;
  std::vector<core::Codec> codecs{core::Codec::Jpeg};  ///< Those that both sides know, best first; never empty.
  v1::QualityMode mode = v1::AUTOMATIC;
  int quality = 85;           ///< 1..100; of lossy codecs, at most.
  int kilobitsPerSecond = 0;  ///< For FIXED_BIT_RATE; > 0 there.
  double maxRate = 60;        ///< Frames per second.
  core::ViewerId follow = 0;  ///< Whose pictures it is sent; 0: its own.
  bool fullChroma = false;
  bool stills = true;  ///< A lossless picture when all is at rest.
};

/// Who has joined.
struct Visitor {
  std::string client;          ///< What it calls itself, for people.
  v1::Role role = v1::DRIVER;  ///< DRIVER or SPECTATOR.
};

/// Where in its picture a viewer points.
struct PickPoint {
  double x = 0;                        ///< From the left edge, 0..1 of the width.
  double y = 0;                        ///< From the top, 0..1 of the height.
  std::optional<core::Camera> camera;  ///< None: the viewer's present one.
};

/// What viewers drive, as the sessions see it. Messages arrive here well-formed, in range and from viewers whose role
/// allows them, except for what needs the scene to judge. Every method is called on the io thread and must return at
/// once: longer work is queued elsewhere and answered through Server::send with `sequence` as in_reply_to. Methods
/// marked † may throw core::InputError, which the session sends to its viewer as an Error.
class Backend {
 public:
  virtual ~Backend() = default;

  /// Everything of the Welcome but viewer_id, limits and role.
  virtual v1::Welcome welcome() = 0;

  virtual void join(core::ViewerId viewer, const Visitor& visitor) = 0;
  virtual void leave(core::ViewerId viewer) = 0;

  virtual void setView(core::ViewerId viewer, std::uint64_t sequence, const View& view) = 0;  // †
  virtual void setCamera(core::ViewerId viewer, std::uint64_t sequence, const core::Camera& camera) = 0;

  /// The viewer has drawn this frame, and so every earlier one. Only ids of frames sent to it arrive here.
  virtual void acknowledge(core::ViewerId viewer, std::uint64_t frameId) = 0;

  /// The viewer cannot go on decoding without a keyframe.
  virtual void requestKeyframe(core::ViewerId viewer) = 0;

  virtual void updateScene(core::ViewerId viewer, std::uint64_t sequence, const v1::UpdateScene& update) = 0;  // †
  virtual void control(core::ViewerId viewer, std::uint64_t sequence, const v1::Control& control) = 0;         // †
  virtual void loadScene(core::ViewerId viewer, std::uint64_t sequence, const v1::LoadScene& scene) = 0;       // †
  virtual void interact(core::ViewerId viewer, std::uint64_t sequence, const v1::Interact& interact) = 0;      // †
  virtual void snapshot(core::ViewerId viewer, std::uint64_t sequence, core::ImageSize size,
                        const std::optional<core::Camera>& camera) = 0;                          // †
  virtual void pick(core::ViewerId viewer, std::uint64_t sequence, const PickPoint& point) = 0;  // †

  /// Adds what the application counts to the page for Prometheus.
  virtual void metrics(MetricsText& text) const = 0;
};

}  // namespace sluice::stream
