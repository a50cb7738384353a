#include <memory>
#include <ostream>

#include "sluice/client/report.h"
#include "sluice/client/requests.h"
#include "verbs/verb.h"

namespace sluice::client {

namespace {

void control(const Context& context, v1::Control::Action action, std::uint32_t times) {
  Connection connection = context.connect();
  for (std::uint32_t i = 0; i < times; ++i) {
    v1::ClientMessage message;
    message.mutable_control()->set_action(action);
    request(connection, std::move(message));
  }
  const v1::Stats stats = currentStats(connection);
  if (context.json) {
    context.output.out << toLine(statsJson(stats));
  } else {
    context.output.out << stateText(stats) << " at " << formatRounded(stats.simulation_time()) << " s, "
                       << stats.steps() << " steps\n";
  }
}

void addControl(CLI::App& app, Action& chosen, const char* name, const char* description, v1::Control::Action action) {
  app.add_subcommand(name, description)->callback([&chosen, action] {
    chosen = [action](const Context& context) { control(context, action, 1); };
  });
}

}  // namespace

void addControls(CLI::App& app, Action& chosen) {
  addControl(app, chosen, "play", "Let time run", v1::Control::PLAY);
  addControl(app, chosen, "pause", "Halt time", v1::Control::PAUSE);
  addControl(app, chosen, "reset", "Go back to the initial state", v1::Control::RESET);

  auto times = std::make_shared<std::uint32_t>(1);
  CLI::App* step = app.add_subcommand("step", "Make single time steps, then pause");
  step->add_option("steps", *times, "How many")
      ->capture_default_str()
      ->check(CLI::Range(1U, 1'000'000U))
      ->type_name("N");
  step->callback(
      [&chosen, times] { chosen = [times](const Context& context) { control(context, v1::Control::STEP, *times); }; });
}

}  // namespace sluice::client
