#include <memory>
#include <ostream>

#include "sluice/client/json.h"
#include "sluice/client/line_of_sight.h"
#include "sluice/client/option_values.h"
#include "sluice/client/report.h"
#include "sluice/client/requests.h"
#include "verbs/verb.h"

namespace sluice::client {

namespace {

struct InteractOptions {
  std::string point;
  std::string camera;
  std::string size = "1280x720";
  double radius = 0;
  double strength = 0;
  double seconds = 0;
  std::uint32_t fluid = 0;
};

void interact(const Context& context, v1::Interact::Action action, const InteractOptions& options) {
  const PicturePoint point = parsePicturePoint(options.point);
  const PictureSize size = parseSize(options.size);
  if (!options.camera.empty()) parseCamera(options.camera, {});  // refused before anything is touched

  Connection connection = context.connect();
  v1::Camera camera = connection.welcome().scene().camera();
  if (!options.camera.empty()) camera = parseCamera(options.camera, camera);

  v1::ClientMessage message;
  v1::Interact& touch = *message.mutable_interact();
  touch.set_action(action);
  *touch.mutable_origin() = camera.eye();
  *touch.mutable_direction() = lineOfSight(camera, size, point);
  touch.set_radius(options.radius);
  touch.set_strength(options.strength);
  touch.set_seconds(options.seconds);
  touch.set_fluid(options.fluid);
  const v1::Interact sent = touch;
  request(connection, std::move(message));

  if (context.json) {
    context.output.out << toLine({{"origin", vectorJson(sent.origin())}, {"direction", vectorJson(sent.direction())}});
  } else {
    context.output.out << "done, from " << formatVector(sent.origin()) << " towards " << formatVector(sent.direction())
                       << '\n';
  }
}

CLI::App* addInteraction(CLI::App& app, Action& chosen, const char* name, const char* description,
                         v1::Interact::Action action, const std::shared_ptr<InteractOptions>& options) {
  CLI::App* verb = app.add_subcommand(name, description);
  verb->add_option("point", options->point, "From the picture's left and top, as shares of its width and height")
      ->required()
      ->type_name("X,Y");
  verb->add_option("--camera", options->camera, "Eye, target and field of view in degrees; else the scene's camera")
      ->type_name("X,Y,Z:X,Y,Z[:FOV]");
  verb->add_option("--size", options->size, "Size of the picture that is touched; its shape counts")
      ->capture_default_str()
      ->type_name("WxH");
  verb->callback([&chosen, action, options] {
    chosen = [action, options](const Context& context) { interact(context, action, *options); };
  });
  return verb;
}

void addForce(CLI::App& app, Action& chosen, const char* name, const char* description, v1::Interact::Action action) {
  auto options = std::make_shared<InteractOptions>();
  CLI::App* verb = addInteraction(app, chosen, name, description, action, options);
  verb->add_option("--radius", options->radius, "Reach about the line of sight, m; else four particle spacings")
      ->check(CLI::PositiveNumber);
  verb->add_option("--strength", options->strength, "Acceleration at the line of sight, m/s²; else 30")
      ->check(CLI::PositiveNumber);
  verb->add_option("--seconds", options->seconds, "Simulated seconds for which it acts; else 0.1")
      ->check(CLI::Range(0.0, 1.0));
}

}  // namespace

void addInteractions(CLI::App& app, Action& chosen) {
  addForce(app, chosen, "push", "Push the fluid away along the line of sight", v1::Interact::PUSH);
  addForce(app, chosen, "pull", "Pull the fluid towards where the line of sight meets it", v1::Interact::PULL);

  auto options = std::make_shared<InteractOptions>();
  CLI::App* add = addInteraction(app, chosen, "add", "Add a ball of fluid where the line of sight meets something",
                                 v1::Interact::ADD, options);
  add->add_option("--radius", options->radius, "Of the ball, m; else four particle spacings")
      ->check(CLI::PositiveNumber);
  add->add_option("--fluid", options->fluid, "Which of the scene's fluids, counted from 0")->capture_default_str();
}

}  // namespace sluice::client
