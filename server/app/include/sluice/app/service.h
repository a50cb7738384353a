#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "sluice/app/live_scene.h"
#include "sluice/app/scene_runner.h"
#include "sluice/stream/server.h"

namespace sluice::app {

struct ServiceOptions {
  LiveScene scene;
  stream::ServerOptions server;
  SceneRunnerOptions runner;
};

/// The whole of `serve`: runs a scene, draws it for every viewer, and streams the pictures. Knows every stage; no
/// stage knows another.
class Service {
 public:
  /// Opens the source (throws core::InputError), the port and the GL context (throw core::EnvironmentError).
  explicit Service(ServiceOptions options);
  ~Service();
  Service(const Service&) = delete;
  Service& operator=(const Service&) = delete;

  /// The port that listens.
  std::uint16_t port() const;

  /// GL_RENDERER.
  const std::string& rendererName() const;

  /// Serves until `stop`; the calling thread is the io thread.
  void run();

  /// Thread-safe.
  void stop(const std::string& reason);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sluice::app
