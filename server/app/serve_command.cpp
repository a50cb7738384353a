#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <pthread.h>

#include <CLI/CLI.hpp>

#include "command_options.h"
#include "commands.h"
#include "log_lines.h"
#include "sluice/app/service.h"
#include "sluice/core/input_error.h"

namespace sluice::app {

namespace {

struct ServeOptions {
  SceneOptions scene;
  std::string listen = "127.0.0.1:8080";
  int maxViewers = 16;
  int maxViewersPerAddress = 0;
  std::string maxSize = "3840x2160";
  double maxRate = 60;
  double maxMessageRate = 500;
  std::uint64_t maxParticles = 2'000'000;
  std::string web;
  std::string tokenFile;
  bool insecure = false;
  std::vector<std::string> allowedOrigins;
  std::string tlsCertificate;
  std::string tlsKey;
  std::string commandLog;
  std::string logFormat = "text";
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

bool isLoopback(const std::string& address) {
  return address == "localhost" || address == "::1" || address.starts_with("127.");
}

/// Tokens of the file's first two lines: the driver's, and, if there is one, the spectators'.
stream::Access accessOf(const ServeOptions& options) {
  stream::Access access;
  if (options.tokenFile.empty()) return access;
  std::ifstream file(options.tokenFile);
  std::getline(file, access.driverToken);
  if (!file && access.driverToken.empty()) throw core::InputError(options.tokenFile, "--token-file", "holds no token");
  std::getline(file, access.spectatorToken);
  for (std::string* token : {&access.driverToken, &access.spectatorToken}) {
    if (!token->empty() && token->back() == '\r') token->pop_back();
  }
  constexpr std::size_t kShortest = 16;
  if (access.driverToken.size() < kShortest ||
      (!access.spectatorToken.empty() && access.spectatorToken.size() < kShortest)) {
    throw core::InputError(options.tokenFile, "--token-file",
                           "holds a token of fewer than 16 characters; make one with: openssl rand -hex 32");
  }
  return access;
}

/// Whoever reaches the port may drive the scene, so more than this machine takes a token, or the word of the operator.
void checkExposure(const ListenAddress& listen, const ServeOptions& options) {
  if (isLoopback(listen.address) || !options.tokenFile.empty() || options.insecure) return;
  throw core::InputError("", "--listen",
                         listen.address +
                             " can be reached from other machines: give --token-file, or --insecure to let "
                             "everybody in who reaches the port");
}

stream::ServerOptions serverOptions(const ServeOptions& options, const ListenAddress& listen, LogFormat log) {
  stream::ServerOptions server;
  server.address = listen.address;
  server.port = listen.port;
  server.access = accessOf(options);
  server.allowedOrigins = options.allowedOrigins;
  server.maxViewers = options.maxViewers;
  server.maxViewersPerAddress = options.maxViewersPerAddress > 0 ? options.maxViewersPerAddress : options.maxViewers;
  server.maxSize = parseSize(options.maxSize);
  server.maxRate = options.maxRate;
  server.maxMessageRate = options.maxMessageRate;
  server.maxParticles = options.maxParticles;
  server.webRoot = webRoot(options.web);
  server.log = [log](const stream::LogEvent& event) { logEvent(log, event); };
  if (options.tlsCertificate.empty() != options.tlsKey.empty()) {
    throw core::InputError("", options.tlsKey.empty() ? "--tls-key" : "--tls-cert",
                           "is missing: a certificate and its key belong together");
  }
  if (!options.tlsCertificate.empty()) server.tls = stream::TlsFiles{options.tlsCertificate, options.tlsKey};
  return server;
}

int serve(const ServeOptions& options) {
  // stdout carries the one line that a parent process waits for; everything else is the log's.
  const LogFormat log = options.logFormat == "json" ? LogFormat::Json : LogFormat::Text;
  startLog(log);
  SignalWatch signals;

  const ListenAddress listen = parseListenAddress(options.listen);
  checkExposure(listen, options);
  ServiceOptions service;
  service.server = serverOptions(options, listen, log);
  // As many frames under way as a far link may need; each viewer gets as few as do for its own.
  service.server.frameWindow = 8;
  service.scene = options.scene.load();
  service.runner.threads = options.scene.threads;
  service.runner.mostParticles = options.maxParticles;
  if (!options.commandLog.empty()) service.runner.commandLog = options.commandLog;
  if (service.server.webRoot.empty()) logEvent(log, {"page_missing", {{"problem", "the browser page is not built"}}});
  const char* scheme = service.server.tls ? "https" : "http";

  Service running(std::move(service));
  signals.watch(running);
  const std::string host = listen.address.find(':') == std::string::npos ? listen.address : "[" + listen.address + "]";
  std::printf("listening on %s://%s:%u\n", scheme, host.c_str(), static_cast<unsigned>(running.port()));
  std::fflush(stdout);
  logEvent(log, {"serving", {{"renderer", running.rendererName()}}});
  running.run();
  logEvent(log, {"stopped", {}});
  return 0;
}

void addLimits(CLI::App& verb, ServeOptions& options) {
  verb.add_option("--max-viewers", options.maxViewers, "Connections at a time")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  verb.add_option("--max-viewers-per-address", options.maxViewersPerAddress, "Of them from one address; 0: all")
      ->check(CLI::Range(0, 10000));
  verb.add_option("--max-size", options.maxSize, "Largest picture that a viewer may ask for")->capture_default_str();
  verb.add_option("--max-rate", options.maxRate, "Frames per second that a viewer may ask for")
      ->check(CLI::Range(0.1, 1000.0))
      ->capture_default_str();
  verb.add_option("--max-message-rate", options.maxMessageRate, "Messages per second that are read from a viewer")
      ->check(CLI::Range(1.0, 1e6))
      ->capture_default_str();
  verb.add_option("--max-particles", options.maxParticles, "Particles that a scene may have which a viewer asks for")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{2'000'000'000}))
      ->capture_default_str();
}

void addSecurity(CLI::App& verb, ServeOptions& options) {
  verb.add_option("--token-file", options.tokenFile,
                  "File whose first line viewers must show to drive the scene, and whose second, if any, to look on");
  verb.add_flag("--insecure", options.insecure, "Let everybody in who reaches a port beyond this machine's own");
  verb.add_option("--allow-origin", options.allowedOrigins,
                  "Origin, such as https://example.org, whose pages may connect; may be given again");
  verb.add_option("--tls-cert", options.tlsCertificate, "PEM file of the certificate chain: serve https and wss");
  verb.add_option("--tls-key", options.tlsKey, "PEM file of its private key");
}

}  // namespace

void addServeCommand(CLI::App& program, Command& chosen) {
  const auto options = std::make_shared<ServeOptions>();
  CLI::App& verb = *program.add_subcommand("serve", "Run a scene and stream it to browsers and clients");
  addSceneOptions(verb, options->scene, "dam_break", false);
  verb.add_option("--listen", options->listen, "ADDRESS:PORT; port 0 takes any free one")->capture_default_str();
  addLimits(verb, *options);
  addSecurity(verb, *options);
  verb.add_option("--web", options->web, "Folder of the browser page");
  verb.add_option("--log-commands", options->commandLog,
                  "File for what viewers ask of the scene, from which replay makes the same run again");
  verb.add_option("--log-format", options->logFormat, "Of the lines on stderr")
      ->check(CLI::IsMember({"text", "json"}))
      ->capture_default_str();
  verb.callback([options, &chosen] { chosen = [options] { return serve(*options); }; });
}

}  // namespace sluice::app
