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
constexpr auto kLongestPause = 5s;

struct WatchOptions {
  std::optional<std::uint64_t> count;  ///< Reports after which to stop.
  std::uint64_t follow = 0;            ///< The viewer whose pictures are received too; 0: none.
  bool reconnect = true;
};

/// The pictures that came between two reports.
struct PictureCount {
  std::uint64_t frames = 0;
  std::uint64_t bytes = 0;
  v1::Frame last;  ///< Without its payload.
};

/// Shows one Stats after another: as a table that is drawn over on a terminal, else line by line.
class Display {
 public:
  explicit Display(const Context& context) : output_(context.output), json_(context.json) {
    if (!json_ && !output_.terminal) output_.out << statsLineHeading() << '\n';
  }

  /// `pictures` are told where there are any to tell of.
  void show(const v1::Stats& stats, const std::optional<PictureCount>& pictures) {
    if (json_) {
      Json json = statsJson(stats);
      if (pictures) json["pictures"] = picturesJson(*pictures);
      output_.out << toLine(json);
    } else if (output_.terminal) {
      clear();
      const std::string table = statsTable(stats) + (pictures ? picturesText(*pictures) + '\n' : "");
      drawnLines_ = std::count(table.begin(), table.end(), '\n');
      output_.out << table;
    } else {
      output_.out << statsLine(stats) << (pictures ? "  " + picturesText(*pictures) : "") << '\n';
    }
    output_.out.flush();
  }

  void tell(const std::string& event) {
    clear();
    output_.out.flush();
    output_.err << "sluice: " << event << std::endl;
  }

 private:
  static Json picturesJson(const PictureCount& pictures) {
    return {{"frames", pictures.frames},
            {"bytes", pictures.bytes},
            {"width", pictures.last.width()},
            {"height", pictures.last.height()}};
  }

  static std::string picturesText(const PictureCount& pictures) {
    return std::to_string(pictures.frames) + " pictures of " + std::to_string(pictures.last.width()) + "x" +
           std::to_string(pictures.last.height()) + ", " + std::to_string(pictures.bytes) + " bytes";
  }

  /// Takes the last table away: cursor up, then erase to the end of the screen (ECMA-48 CUU and ED).
  void clear() {
    if (drawnLines_ > 0) output_.out << "\x1b[" << drawnLines_ << "A\x1b[J";
    drawnLines_ = 0;
  }

  Output output_;
  bool json_;
  std::ptrdiff_t drawnLines_ = 0;
};

/// Asks for the pictures of another viewer; the size is theirs.
void follow(Connection& connection, std::uint64_t viewer) {
  v1::ClientMessage message;
  v1::SetView& view = *message.mutable_set_view();
  view.set_width(1);
  view.set_height(1);
  view.add_codecs(v1::JPEG);
  view.set_follow(viewer);
  connection.send(std::move(message));
}

/// Receives until as many reports as `options.count` were shown; that is counted down. Without it there is no end but
/// the connection's. Pictures are acknowledged as they come, and counted.
void showUntilDisconnected(Connection& connection, Display& display, WatchOptions& options) {
  std::optional<PictureCount> pictures;
  if (options.follow != 0) {
    follow(connection, options.follow);
    pictures.emplace();
  }
  while (!options.count || *options.count > 0) {
    std::optional<v1::ServerMessage> message = connection.receive(Connection::Clock::time_point::max());
    if (!message) continue;
    if (message->has_error()) throw RequestError(describe(message->error()));
    if (message->has_frame() && pictures) {
      v1::ClientMessage acknowledgement;
      acknowledgement.mutable_frame_ack()->set_frame_id(message->frame().frame_id());
      connection.send(std::move(acknowledgement));
      ++pictures->frames;
      pictures->bytes += message->frame().payload().size();
      message->mutable_frame()->clear_payload();
      pictures->last.Swap(message->mutable_frame());
    }
    if (!message->has_stats()) continue;
    display.show(message->stats(), pictures);
    if (pictures) pictures->frames = pictures->bytes = 0;
    if (options.count) --*options.count;
  }
}

std::string secondsText(std::chrono::milliseconds time) {
  return formatRounded(std::chrono::duration<double>(time).count()) + " s";
}

void watch(const Context& context, WatchOptions options) {
  Display display(context);
  // A server that cannot be reached to begin with is told like everywhere else.
  std::optional<Connection> connection(std::in_place, context.server, context.timeout, context.access);
  std::chrono::milliseconds pause = kFirstPause;
  while (true) {
    try {
      if (!connection) {
        connection.emplace(context.server, context.timeout, context.access);
        display.tell("connected again");
      }
      pause = kFirstPause;
      showUntilDisconnected(*connection, display, options);
      return;
    } catch (const ConnectionError& error) {
      if (!options.reconnect) throw;
      display.tell(std::string(error.what()) + "; trying again in " + secondsText(pause));
      connection.reset();
      std::this_thread::sleep_for(pause);
      pause = std::min<std::chrono::milliseconds>(2 * pause, kLongestPause);
    }
  }
}

}  // namespace

void addWatch(CLI::App& app, Action& chosen) {
  auto options = std::make_shared<WatchOptions>();
  auto count = std::make_shared<std::uint64_t>(0);
  CLI::App* verb = app.add_subcommand(
      "watch", "Show how the simulation goes on, until interrupted; comes back when the server does");
  CLI::Option* counted =
      verb->add_option("--count", *count, "Stop after so many reports")->check(CLI::PositiveNumber)->type_name("N");
  verb->add_option("--follow", options->follow, "Receive the pictures of a viewer that `viewers` lists, and count them")
      ->check(CLI::PositiveNumber)
      ->type_name("VIEWER");
  verb->add_flag_callback(
      "--no-reconnect", [options] { options->reconnect = false; }, "End with exit code 3 when the server goes away");
  verb->callback([&chosen, options, count, counted] {
    if (counted->count() > 0) options->count = *count;
    chosen = [options](const Context& context) { watch(context, *options); };
  });
}

}  // namespace sluice::client
