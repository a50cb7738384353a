#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "sluice/core/frame.h"
#include "sluice/stream/backend.h"
#include "sluice/stream/send_result.h"
#include "sluice/v1/session.pb.h"

namespace sluice::stream {

struct ServerOptions {
  std::string address = "127.0.0.1";
  std::uint16_t port = 8080;        ///< 0: any free port; see Server::port.
  std::filesystem::path webRoot{};  ///< Folder of the page; empty: none is served.
  int maxViewers = 16;
  core::ImageSize maxSize{3840, 2160};
  std::uint32_t maxMessageBytes = 1U << 20U;       ///< Of a viewer's message; larger ones close with 1009.
  std::uint32_t frameWindow = 2;                   ///< Frames under way to one viewer.
  double maxRate = 60;                             ///< Frames per second.
  std::chrono::milliseconds writeTimeout{10'000};  ///< A viewer that takes no bytes for this long is dropped.
  std::chrono::milliseconds idleTimeout{30'000};   ///< A viewer silent for this long, WebSocket pings included.
  /// Origins, such as "https://example.org", whose pages may connect beside the server's own page.
  std::vector<std::string> allowedOrigins{};
  /// Takes one line for every viewer that comes or goes; called on the io thread. Empty: nobody is told.
  std::function<void(const std::string&)> log{};
};

/// The HTTP and WebSocket server: the static page, /healthz and /stream. Runs on one io thread.
class Server {
 public:
  /// Opens the port. Throws core::EnvironmentError where it is taken or not allowed. `backend` must outlive the server.
  Server(const ServerOptions& options, Backend& backend);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// The port that listens.
  std::uint16_t port() const;

  /// Serves until `stop`; the calling thread is the io thread.
  void run();

  /// Closes every session with the reason, then lets `run` return, within two or three seconds whatever the viewers
  /// do. Thread-safe; also from a signal thread.
  void stop(const std::string& reason);

  // Thread-safe; a viewer that has left is ignored. What a viewer is sent is bounded: frames by its window, Stats and
  // PlanChanged by latest-wins slots, and other messages by a queue whose overflow drops the viewer.

  /// Serialises the frame on the calling thread. A frame with `inReplyTo` answers a SnapshotRequest and stands outside
  /// the window.
  SendResult sendFrame(core::ViewerId viewer, const core::EncodedFrame& frame);
  SendResult send(core::ViewerId viewer, v1::ServerMessage message);
  /// To every viewer that has said Hello.
  void broadcast(v1::ServerMessage message);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sluice::stream
