#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sluice/core/camera.h"
#include "sluice/core/frame.h"
#include "sluice/v1/session.pb.h"

namespace sluice::stream {

/// How a viewer wants its stream; checked against the limits.
struct View {
  core::ImageSize size;
  core::Codec codec = core::Codec::Jpeg;  ///< The first that both sides know.
  int quality = 85;                       ///< 1..100.
  double maxRate = 60;                    ///< Frames per second.
};

/// What viewers drive, as the sessions see it. Messages arrive here well-formed and in range, except for what needs
/// the scene to judge. Every method is called on the io thread and must return at once: longer work is queued
/// elsewhere and answered through Server::send with `sequence` as in_reply_to. Methods marked † may throw
/// core::InputError, which the session sends to its viewer as an Error.
class Backend {
 public:
  virtual ~Backend() = default;

  /// Everything of the Welcome but viewer_id and limits.
  virtual v1::Welcome welcome() = 0;

  virtual void join(core::ViewerId viewer) = 0;
  virtual void leave(core::ViewerId viewer) = 0;

  virtual void setView(core::ViewerId viewer, std::uint64_t sequence, const View& view) = 0;
  virtual void setCamera(core::ViewerId viewer, std::uint64_t sequence, const core::Camera& camera) = 0;

  /// The viewer has drawn this frame, and so every earlier one. Only ids of frames sent to it arrive here.
  virtual void acknowledge(core::ViewerId viewer, std::uint64_t frameId) = 0;

  virtual void updateScene(core::ViewerId viewer, std::uint64_t sequence, const v1::UpdateScene& update) = 0;  // †
  virtual void control(core::ViewerId viewer, std::uint64_t sequence, v1::Control::Action action) = 0;         // †
  virtual void loadScene(core::ViewerId viewer, std::uint64_t sequence, const v1::LoadScene& scene) = 0;       // †
  virtual void snapshot(core::ViewerId viewer, std::uint64_t sequence, core::ImageSize size,
                        const std::optional<core::Camera>& camera) = 0;  // †
};

}  // namespace sluice::stream
