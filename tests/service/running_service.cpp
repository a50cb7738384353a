#include "running_service.h"

#include <cstring>
#include <set>
#include <stdexcept>
#include <tuple>
#include <utility>

#include <google/protobuf/text_format.h>
#include <png.h>

#include "sluice/scene/scene.h"
#include "viewer/raw_socket.h"

namespace sluice::test {

namespace {

app::ServiceOptions serviceOptions(const std::string& sceneText, stream::ServerOptions options,
                                   app::SceneRunnerOptions runner) {
  options.port = 0;
  app::ServiceOptions service;
  service.scene.scene = scene::parse(sceneText, "test scene");
  service.server = std::move(options);
  service.runner = std::move(runner);
  service.runner.threads = 2;
  return service;
}

}  // namespace

RunningService::RunningService(const std::string& sceneText, stream::ServerOptions options,
                               app::SceneRunnerOptions runner)
    : service_(serviceOptions(sceneText, std::move(options), std::move(runner))), thread_([this] { service_.run(); }) {}

RunningService::~RunningService() {
  service_.stop("the test is over");
  thread_.join();
}

TestViewer RunningService::viewer() {
  TestViewer viewer("127.0.0.1", port());
  viewer.hello();
  return viewer;
}

double Picture::differingShare(const Picture& other) const {
  if (width != other.width || height != other.height) return 1;
  std::size_t differing = 0;
  for (std::size_t p = 0; p < rgb.size(); p += 3) {
    differing += std::memcmp(&rgb[p], &other.rgb[p], 3) == 0 ? 0 : 1;
  }
  return static_cast<double>(differing) / (static_cast<double>(width) * height);
}

std::size_t Picture::colours() const {
  std::set<std::tuple<int, int, int>> seen;
  for (std::size_t p = 0; p < rgb.size(); p += 3) seen.emplace(rgb[p], rgb[p + 1], rgb[p + 2]);
  return seen.size();
}

Picture decodePng(const std::string& bytes) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_memory(&image, bytes.data(), bytes.size())) {
    throw std::runtime_error(std::string("no PNG: ") + image.message);
  }
  image.format = PNG_FORMAT_RGB;
  Picture picture{static_cast<int>(image.width), static_cast<int>(image.height), {}};
  picture.rgb.resize(PNG_IMAGE_SIZE(image));
  if (!png_image_finish_read(&image, nullptr, picture.rgb.data(), 0, nullptr)) {
    throw std::runtime_error(std::string("broken PNG: ") + image.message);
  }
  return picture;
}

v1::Camera cameraAt(double x, double y, double z) {
  v1::Camera camera;
  camera.mutable_eye()->set_x(x);
  camera.mutable_eye()->set_y(y);
  camera.mutable_eye()->set_z(z);
  camera.mutable_target()->set_x(0.4);
  camera.mutable_target()->set_y(0.3);
  camera.mutable_target()->set_z(0.25);
  return camera;
}

v1::ClientMessage updateMessage(const std::string& sceneText, const std::vector<std::string>& paths) {
  v1::ClientMessage message;
  v1::UpdateScene& update = *message.mutable_update_scene();
  if (!google::protobuf::TextFormat::ParseFromString(sceneText, update.mutable_scene())) {
    throw std::logic_error("the test's scene text does not parse: " + sceneText);
  }
  for (const std::string& path : paths) update.mutable_mask()->add_paths(path);
  return message;
}

v1::ClientMessage controlMessage(v1::Control::Action action, double untilSeconds) {
  v1::ClientMessage message;
  message.mutable_control()->set_action(action);
  message.mutable_control()->set_until_seconds(untilSeconds);
  return message;
}

double metric(std::uint16_t port, const std::string& name) {
  const std::string page = httpGet(port, "/metrics");
  const std::size_t line = page.find("\n" + name + " ");
  if (line == std::string::npos) throw std::runtime_error("no metric " + name + " in: " + page);
  return std::stod(page.substr(line + name.size() + 2));
}

}  // namespace sluice::test
