#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <ostream>
#include <thread>

#include "sluice/client/failure.h"
#include "sluice/client/report.h"
#include "sluice/client/requests.h"
#include "verbs/verb.h"

namespace sluice::client {

namespace {

using namespace std::chrono_literals;

// Waits before a further attempt to connect: short at first, for a server that is just being started again.
constexpr auto kFirstPause = 250ms;
constexpr auto kLongestPause = 4s;

/// Shows one Stats after another: as a table that is drawn over on a terminal, else line by line.
class Display {
 public:
  explicit Display(const Context& context) : output_(context.output), json_(context.json) {
    if (!json_ && !output_.terminal) output_.out << statsLineHeading() << '\n';
  }

  void show(const v1::Stats& stats) {
    if (json_) {
      output_.out << toLine(statsJson(stats));
    } else if (output_.terminal) {
      clear();
      const std::string table = statsTable(stats);
      drawnLines_ = std::count(table.begin(), table.end(), '\n');
      output_.out << table;
    } else {
      output_.out << statsLine(stats) << '\n';
    }
    output_.out.flush();
  }

  void tell(const std::string& event) {
    clear();
    output_.out.flush();
    output_.err << "sluice: " << event << std::endl;
  }

 private:
  /// Takes the last table away: cursor up, then erase to the end of the screen (ECMA-48 CUU and ED).
  void clear() {
    if (drawnLines_ > 0) output_.out << "\x1b[" << drawnLines_ << "A\x1b[J";
    drawnLines_ = 0;
  }

  Output output_;
  bool json_;
  std::ptrdiff_t drawnLines_ = 0;
};

/// `remaining` counts down the Stats still to show; without it there is no end but the connection's.
void showUntilDisconnected(Connection& connection, Display& display, std::optional<std::uint64_t>& remaining) {
  while (!remaining || *remaining > 0) {
    const std::optional<v1::ServerMessage> message = connection.receive(Connection::Clock::time_point::max());
    if (!message || !message->has_stats()) continue;
    display.show(message->stats());
    if (remaining) --*remaining;
  }
}

void watch(const Context& context, std::optional<std::uint64_t> remaining) {
  Display display(context);
  // A server that cannot be reached to begin with is told like everywhere else.
  std::optional<Connection> connection(std::in_place, context.server, context.timeout);
  std::chrono::milliseconds pause = kFirstPause;
  while (true) {
    try {
      if (!connection) {
        connection.emplace(context.server, context.timeout);
        display.tell("connected again");
      }
      pause = kFirstPause;
      showUntilDisconnected(*connection, display, remaining);
      return;
    } catch (const ConnectionError& error) {
      if (connection) display.tell(std::string(error.what()) + "; trying again");
      connection.reset();
      std::this_thread::sleep_for(pause);
      pause = std::min<std::chrono::milliseconds>(2 * pause, kLongestPause);
    }
  }
}

}  // namespace

void addWatch(CLI::App& app, Action& chosen) {
  auto count = std::make_shared<std::uint64_t>(0);
  CLI::App* verb = app.add_subcommand("watch", "Show how the simulation goes on, until interrupted");
  CLI::Option* option =
      verb->add_option("--count", *count, "Stop after so many reports")->check(CLI::PositiveNumber)->type_name("N");
  verb->callback([&chosen, count, option] {
    const auto remaining = option->count() > 0 ? std::optional(*count) : std::nullopt;
    chosen = [remaining](const Context& context) { watch(context, remaining); };
  });
}

}  // namespace sluice::client
