#include <csignal>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>

#include <pthread.h>

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>

#include "command_options.h"
#include "commands.h"
#include "sluice/app/service.h"
#include "sluice/core/input_error.h"

namespace sluice::app {

namespace {

struct ServeOptions {
  SceneOptions scene;
  std::string listen = "127.0.0.1:8080";
  int maxViewers = 16;
  std::string web;
};

/// Ends the service on SIGINT or SIGTERM. Must be made before any other thread, so that all inherit the blocked
/// signals and one thread alone receives them.
class SignalWatch {
 public:
  SignalWatch() {
    sigemptyset(&signals_);
    sigaddset(&signals_, SIGINT);
    sigaddset(&signals_, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &signals_, nullptr);
  }

  ~SignalWatch() {
    if (!thread_.joinable()) return;
    pthread_kill(thread_.native_handle(), SIGTERM);
    thread_.join();
  }

  void watch(Service& service) {
    thread_ = std::thread([this, &service] {
      int received = 0;
      sigwait(&signals_, &received);
      service.stop("the server shuts down");
    });
  }

 private:
  sigset_t signals_{};
  std::thread thread_;
};

/// The page that stands beside the program: in share/sluice/web of an installation, or in web/dist of the source tree
/// whose build folder holds the program.
std::filesystem::path findWebRoot() {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) return {};
  const std::filesystem::path folder = program.parent_path();
  for (const char* candidate : {"../share/sluice/web", "../../../web/dist"}) {
    const std::filesystem::path root = folder / candidate;
    if (std::filesystem::is_regular_file(root / "index.html", error)) return std::filesystem::canonical(root, error);
  }
  return {};
}

std::filesystem::path webRoot(const std::string& given) {
  if (given.empty()) return findWebRoot();
  if (!std::filesystem::is_regular_file(std::filesystem::path(given) / "index.html")) {
    throw core::InputError(given, "--web", "holds no index.html");
  }
  return given;
}

int serve(const ServeOptions& options) {
  // stdout carries the one line that a parent process waits for; everything else is the log's.
  spdlog::set_default_logger(spdlog::stderr_color_mt("sluice"));
  SignalWatch signals;

  const ListenAddress listen = parseListenAddress(options.listen);
  ServiceOptions service;
  service.scene = options.scene.load();
  service.threads = options.scene.threads;
  service.server.address = listen.address;
  service.server.port = listen.port;
  service.server.maxViewers = options.maxViewers;
  service.server.webRoot = webRoot(options.web);
  service.server.log = [](const std::string& line) { spdlog::info("{}", line); };
  if (service.server.webRoot.empty()) spdlog::warn("the browser page is not built; serving the stream alone");

  Service running(std::move(service));
  signals.watch(running);
  const std::string host = listen.address.find(':') == std::string::npos ? listen.address : "[" + listen.address + "]";
  std::printf("listening on http://%s:%u\n", host.c_str(), static_cast<unsigned>(running.port()));
  std::fflush(stdout);
  spdlog::info("drawing with {}", running.rendererName());
  running.run();
  return 0;
}

}  // namespace

void addServeCommand(CLI::App& program, Command& chosen) {
  const auto options = std::make_shared<ServeOptions>();
  CLI::App& verb = *program.add_subcommand("serve", "Run a scene and stream it to browsers and clients");
  addSceneOptions(verb, options->scene, "dam_break", false);
  verb.add_option("--listen", options->listen, "ADDRESS:PORT; port 0 takes any free one")->capture_default_str();
  verb.add_option("--max-viewers", options->maxViewers, "Connections at a time")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  verb.add_option("--web", options->web, "Folder of the browser page");
  verb.callback([options, &chosen] { chosen = [options] { return serve(*options); }; });
}

}  // namespace sluice::app
