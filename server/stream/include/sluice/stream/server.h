#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sluice/core/frame.h"
#include "sluice/stream/access.h"
#include "sluice/stream/backend.h"
#include "sluice/stream/send_result.h"
#include "sluice/v1/session.pb.h"

namespace sluice::stream {

/// PEM files of a certificate chain and its private key.
struct TlsFiles {
  std::filesystem::path certificate;
  std::filesystem::path key;
};

/// Something worth a line in the log: "viewer_connected" with the viewer and where it is.
struct LogEvent {
  std::string_view name;
  std::vector<std::pair<std::string_view, std::string>> fields;
};

struct ServerOptions {
  std::string address = "127.0.0.1";
  std::uint16_t port = 8080;        ///< 0: any free port; see Server::port.
  std::filesystem::path webRoot{};  ///< Folder of the page; empty: none is served.
  std::optional<TlsFiles> tls{};    ///< None: plain HTTP.
  Access access{};
  int maxViewers = 16;
  int maxViewersPerAddress = 16;
  core::ImageSize maxSize{3840, 2160};
  std::uint32_t maxMessageBytes = 1U << 20U;       ///< Of a viewer's message; larger ones close with 1009.
  std::uint32_t frameWindow = 2;                   ///< Frames under way to one viewer.
  double maxRate = 60;                             ///< Frames per second.
  double maxMessageRate = 500;                     ///< Messages a viewer may send a second; more are read later.
  std::uint64_t maxParticles = 100'000'000;        ///< Of a scene that a viewer asks for; told in the Welcome.
  std::chrono::milliseconds helloTimeout{10'000};  ///< A connection that says no Hello for this long is closed.
  std::chrono::milliseconds writeTimeout{10'000};  ///< A viewer that takes no bytes for this long is dropped.
  std::chrono::milliseconds idleTimeout{30'000};   ///< A viewer silent for this long, WebSocket pings included.
  /// Origins, such as "https://example.org", whose pages may connect beside the server's own page.
  std::vector<std::string> allowedOrigins{};
  /// Told of every viewer that comes or goes; called on the io thread. Never holds a token. Empty: nobody is told.
  std::function<void(const LogEvent&)> log{};
  /// For tests: asked before every read, write and wait of a connection, on the io thread; true makes it fail. Empty:
  /// nothing fails but by itself.
  std::function<bool()> failsNow{};
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

  /// Serialises the frame on the calling thread. A delivery with `inReplyTo` answers a SnapshotRequest and stands
  /// outside the window.
  SendResult sendFrame(const core::EncodedFrame& frame, const core::Delivery& delivery);
  SendResult send(core::ViewerId viewer, v1::ServerMessage message);
  /// To every viewer that has said Hello.
  void broadcast(v1::ServerMessage message);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sluice::stream
