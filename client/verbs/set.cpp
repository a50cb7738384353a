#include "verbs/update.h"
#include "verbs/verb.h"

#include <memory>
#include <ostream>

#include "sluice/client/json.h"
#include "sluice/client/requests.h"
#include "sluice/client/scene_update.h"

namespace sluice::client {

namespace {

void set(const Context& context, const std::vector<std::string>& assignments) {
  const v1::UpdateScene update = sceneUpdate(assignments);
  Connection connection = context.connect();
  const bool restarted = applyUpdate(connection, update);

  if (context.json) {
    const auto& paths = update.mask().paths();
    context.output.out << toLine(
        {{"changed", Json(std::vector<std::string>(paths.begin(), paths.end()))}, {"restarted", restarted}});
  } else if (restarted) {
    context.output.out << "changed; the scene started again\n";
  } else {
    context.output.out << "changed\n";
  }
}

}  // namespace

bool applyUpdate(Connection& connection, const v1::UpdateScene& update) {
  bool restarted = false;
  const auto watch = [&](const v1::ServerMessage& message) {
    restarted = restarted || message.scene_changed().restarted();
  };
  v1::ClientMessage message;
  *message.mutable_update_scene() = update;
  request(connection, std::move(message), watch);
  return restarted;
}

void addSet(CLI::App& app, Action& chosen) {
  auto assignments = std::make_shared<std::vector<std::string>>();
  CLI::App* verb = app.add_subcommand("set", "Change parameters of the scene: all that are given, or none");
  verb->add_option("assignments", *assignments, "Such as look.smoothing.time=2 or simulation.gravity=0,-3,0")
      ->required()
      ->type_name("PATH=VALUE");
  verb->callback(
      [&chosen, assignments] { chosen = [assignments](const Context& context) { set(context, *assignments); }; });
}

}  // namespace sluice::client
