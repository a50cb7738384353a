#include <memory>
#include <ostream>
#include <string>

#include "sluice/client/json.h"
#include "sluice/client/option_values.h"
#include "sluice/client/report.h"
#include "sluice/client/scene_update.h"
#include "verbs/update.h"
#include "verbs/verb.h"

namespace sluice::client {

namespace {

struct CameraOptions {
  std::string eye;
  std::string target;
  std::string up;
  std::string fov;
};

std::vector<std::string> assignments(const CameraOptions& options) {
  std::vector<std::string> result;
  const auto add = [&](const char* path, const std::string& value) {
    if (!value.empty()) result.push_back(std::string(path) + "=" + value);
  };
  add("camera.eye", options.eye);
  add("camera.target", options.target);
  add("camera.up", options.up);
  add("camera.vertical_fov_degrees", options.fov);
  return result;
}

void print(const Context& context, const v1::Camera& camera) {
  if (context.json) {
    context.output.out << toLine({{"eye", vectorJson(camera.eye())},
                                  {"target", vectorJson(camera.target())},
                                  {"up", vectorJson(camera.up())},
                                  {"vertical_fov_degrees", camera.vertical_fov_degrees()}});
    return;
  }
  // In the form that the options take.
  context.output.out << "--eye " << formatVector(camera.eye()) << " --target " << formatVector(camera.target())
                     << " --up " << formatVector(camera.up()) << " --fov " << formatExact(camera.vertical_fov_degrees())
                     << '\n';
}

void camera(const Context& context, const CameraOptions& options) {
  const v1::UpdateScene update = sceneUpdate(assignments(options));
  Connection connection = context.connect();
  v1::Camera present = connection.welcome().scene().camera();
  if (update.mask().paths_size() > 0) {
    applyUpdate(connection, update);
    const v1::Camera& changed = update.scene().camera();
    if (changed.has_eye()) *present.mutable_eye() = changed.eye();
    if (changed.has_target()) *present.mutable_target() = changed.target();
    if (changed.has_up()) *present.mutable_up() = changed.up();
    if (changed.has_vertical_fov_degrees()) present.set_vertical_fov_degrees(changed.vertical_fov_degrees());
  }
  print(context, present);
}

}  // namespace

void addCamera(CLI::App& app, Action& chosen) {
  auto options = std::make_shared<CameraOptions>();
  CLI::App* verb = app.add_subcommand("camera", "Show or change the camera with which viewers of the scene start");
  verb->add_option("--eye", options->eye, "Position of the eye, m")->type_name("X,Y,Z");
  verb->add_option("--target", options->target, "Point in the middle of the picture, m")->type_name("X,Y,Z");
  verb->add_option("--up", options->up, "Direction that is up in the picture")->type_name("X,Y,Z");
  verb->add_option("--fov", options->fov, "Vertical field of view")->type_name("DEGREES");
  verb->callback([&chosen, options] { chosen = [options](const Context& context) { camera(context, *options); }; });
}

}  // namespace sluice::client
