#pragma once

#include <thread>

#include "fake_backend.h"
#include "sluice/stream/server.h"
#include "viewer/test_viewer.h"

namespace sluice::stream::test {

/// A real server on a free port of the loopback, with the fake backend behind it.
class LiveServer {
 public:
  explicit LiveServer(ServerOptions options = {}, std::size_t frameBytes = 1000)
      : backend(frameBytes, options.frameWindow), server_(onFreePort(options), backend) {
    backend.start(server_);
    thread_ = std::thread([this] { server_.run(); });
  }
  ~LiveServer() { stop("the test is over"); }
  LiveServer(const LiveServer&) = delete;
  LiveServer& operator=(const LiveServer&) = delete;

  /// Returns once the server has stopped.
  void stop(const std::string& reason) {
    server_.stop(reason);
    if (thread_.joinable()) thread_.join();
    backend.finish();
  }

  Server* operator->() { return &server_; }
  std::uint16_t port() const { return server_.port(); }

  sluice::test::TestViewer connect(const sluice::test::ConnectOptions& options = {}) const {
    return {"127.0.0.1", server_.port(), options};
  }

  FakeBackend backend;

 private:
  static ServerOptions onFreePort(ServerOptions options) {
    options.port = 0;
    return options;
  }

  Server server_;
  std::thread thread_;
};

}  // namespace sluice::stream::test
