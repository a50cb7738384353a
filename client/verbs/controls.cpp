#include <memory>
#include <ostream>

#include "sluice/client/report.h"
#include "sluice/client/requests.h"
#include "verbs/verb.h"

namespace sluice::client {

namespace {

v1::ClientMessage controlMessage(v1::Control::Action action) {
  v1::ClientMessage message;
  message.mutable_control()->set_action(action);
  return message;
}

void tellState(const Context& context, Connection& connection) {
  const v1::Stats stats = currentStats(connection);
  if (context.json) {
    context.output.out << toLine(statsJson(stats));
  } else {
    context.output.out << stateText(stats) << " at " << formatRounded(stats.simulation_time()) << " s, "
                       << stats.steps() << " steps\n";
  }
}

void control(const Context& context, v1::Control::Action action, std::uint32_t times) {
  Connection connection = context.connect();
  for (std::uint32_t i = 0; i < times; ++i) request(connection, controlMessage(action));
  tellState(context, connection);
}

void stepUntil(const Context& context, double seconds) {
  Connection connection = context.connect();
  v1::ClientMessage message = controlMessage(v1::Control::STEP);
  message.mutable_control()->set_until_seconds(seconds);
  // The answer comes once the time is reached, however long the steps take.
  request(connection, std::move(message), Connection::Clock::time_point::max());
  tellState(context, connection);
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
  auto until = std::make_shared<double>(0);
  CLI::App* step = app.add_subcommand("step", "Make time steps, then pause");
  CLI::Option* count = step->add_option("steps", *times, "How many")
                           ->capture_default_str()
                           ->check(CLI::Range(1U, 1'000'000U))
                           ->type_name("N");
  step->add_option("--until", *until, "Step until exactly this simulated time, and wait for it")
      ->check(CLI::PositiveNumber)
      ->excludes(count)
      ->type_name("SECONDS");
  step->callback([&chosen, times, until] {
    chosen = [times, until](const Context& context) {
      if (*until > 0) return stepUntil(context, *until);
      control(context, v1::Control::STEP, *times);
    };
  });
}

}  // namespace sluice::client
