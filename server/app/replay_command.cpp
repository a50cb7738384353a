#include <cstdio>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "commands.h"
#include "json.h"
#include "sluice/app/command_log.h"
#include "sluice/app/saved_state.h"

namespace sluice::app {

namespace {

struct ReplayOptions {
  std::string log;
  std::string save;
  int threads = 0;
  bool json = false;
};

const char* outcomeOf(const std::optional<bool>& same) {
  if (!same) return "the log has no end to compare with";
  return *same ? "the particles are those of the recorded run, bit for bit"
               : "the particles differ from the recorded run";
}

int replayLog(const ReplayOptions& options) {
  const Replay result = replay(readCommandLog(options.log), options.threads);
  const std::size_t particles = result.run->source().snapshot()->size();
  if (options.json) {
    Json json = {{"steps", result.steps},
                 {"particles", particles},
                 {"simulated_seconds", result.run->source().time()},
                 {"same", result.same ? Json(*result.same) : Json(nullptr)}};
    std::printf("%s\n", json.dump().c_str());
  } else {
    std::printf("%llu steps, %zu particles, %.4f s simulated: %s\n", static_cast<unsigned long long>(result.steps),
                particles, result.run->source().time(), outcomeOf(result.same));
  }
  if (!options.save.empty()) saveState(options.save, result.run->scene()->scene, result.run->source());
  return result.same.value_or(true) ? 0 : 1;
}

}  // namespace

void addReplayCommand(CLI::App& program, Command& chosen) {
  const auto options = std::make_shared<ReplayOptions>();
  CLI::App& verb = *program.add_subcommand(
      "replay", "Make a run again from what serve --log-commands has written, and compare its particles");
  verb.add_option("LOG", options->log, "The log of commands")->required();
  verb.add_option("--save", options->save, "File for the state at its end, from which simulate --resume goes on");
  verb.add_option("--threads", options->threads, "Of the simulation; 0: one for each core")->check(CLI::Range(0, 1024));
  verb.add_flag("--json", options->json, "Print figures as one line of JSON");
  verb.callback([options, &chosen] { chosen = [options] { return replayLog(*options); }; });
}

}  // namespace sluice::app
