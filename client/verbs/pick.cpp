#include <memory>
#include <ostream>

#include "sluice/client/failure.h"
#include "sluice/client/json.h"
#include "sluice/client/option_values.h"
#include "sluice/client/report.h"
#include "sluice/client/requests.h"
#include "verbs/verb.h"

namespace sluice::client {

namespace {

struct PickOptions {
  std::string point;
  std::string camera;
  std::string size = "1280x720";
};

/// What is not there is null.
Json pickedJson(const v1::Picked& picked) {
  Json json = {
      {"hit", picked.hit()}, {"position", nullptr}, {"depth", nullptr}, {"thickness", nullptr},
      {"velocity", nullptr}, {"density", nullptr},  {"fluid", nullptr}, {"simulation_time", picked.simulation_time()}};
  if (!picked.hit()) return json;
  json["position"] = vectorJson(picked.position());
  json["depth"] = picked.depth();
  json["thickness"] = picked.thickness();
  json["velocity"] = vectorJson(picked.velocity());
  json["density"] = picked.density();
  json["fluid"] = picked.fluid();
  return json;
}

std::string rounded(const v1::Vec3& v) {
  return formatRounded(v.x()) + ", " + formatRounded(v.y()) + ", " + formatRounded(v.z());
}

void printText(std::ostream& out, const v1::Picked& picked) {
  if (!picked.hit()) {
    out << "no fluid there\n";
    return;
  }
  out << "position   " << rounded(picked.position()) << " m\n"
      << "depth      " << formatRounded(picked.depth()) << " m\n"
      << "thickness  " << formatRounded(picked.thickness()) << " m\n"
      << "velocity   " << rounded(picked.velocity()) << " m/s\n"
      << "density    " << formatRounded(picked.density()) << " kg/m³\n"
      << "fluid      " << picked.fluid() << '\n';
}

/// What is picked from is this viewer's picture, so it needs one: its shape says where the point lies.
void openView(Connection& connection, const PictureSize& size) {
  v1::ClientMessage message;
  v1::SetView& view = *message.mutable_set_view();
  view.set_width(size.width);
  view.set_height(size.height);
  view.set_no_still(true);
  connection.send(std::move(message));
}

void pick(const Context& context, const PickOptions& options) {
  const PicturePoint point = parsePicturePoint(options.point);
  const PictureSize size = parseSize(options.size);
  if (!options.camera.empty()) parseCamera(options.camera, {});  // refused before anything is touched

  Connection connection = context.connect();
  openView(connection, size);
  v1::ClientMessage message;
  message.mutable_pick()->set_x(point.x);
  message.mutable_pick()->set_y(point.y);
  v1::Camera& camera = *message.mutable_pick()->mutable_camera();
  camera = connection.welcome().scene().camera();
  if (!options.camera.empty()) camera = parseCamera(options.camera, camera);

  const v1::ServerMessage reply = request(connection, std::move(message), [](const v1::ServerMessage& other) {
    if (other.has_error()) throw RequestError(describe(other.error()));  // the view's
  });
  if (context.json) {
    context.output.out << toLine(pickedJson(reply.picked()));
  } else {
    printText(context.output.out, reply.picked());
  }
}

}  // namespace

void addPick(CLI::App& app, Action& chosen) {
  auto options = std::make_shared<PickOptions>();
  CLI::App* verb = app.add_subcommand("pick", "Tell what fluid stands under a point of the picture");
  verb->add_option("point", options->point, "From the picture's left and top, as shares of its width and height")
      ->required()
      ->type_name("X,Y");
  verb->add_option("--camera", options->camera, "Eye, target and field of view in degrees; else the scene's camera")
      ->type_name("X,Y,Z:X,Y,Z[:FOV]");
  verb->add_option("--size", options->size, "Size of the picture; its shape counts")
      ->capture_default_str()
      ->type_name("WxH");
  verb->callback([&chosen, options] { chosen = [options](const Context& context) { pick(context, *options); }; });
}

}  // namespace sluice::client
