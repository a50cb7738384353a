#include <chrono>
#include <fstream>
#include <memory>
#include <string>
#include <thread>

#include <CLI/StringTools.hpp>

#include "sluice/client/failure.h"
#include "verbs/verb.h"

namespace sluice::client {

namespace {

void wait(const std::vector<std::string>& words) {
  double seconds = 0;
  if (words.size() != 2 || !CLI::detail::lexical_cast(words[1], seconds) || !(seconds >= 0 && seconds <= 86400)) {
    throw UsageError("a pause is written 'wait SECONDS', from 0 to 86400");
  }
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

void runLine(const Context& context, const std::string& line) {
  std::vector<std::string> words = CLI::detail::split_up(line);
  if (words.empty() || words.front().starts_with('#')) return;
  if (words.front() == "wait") return wait(words);
  if (words.front() == "script") throw UsageError("a script cannot run another");
  words.insert(words.end(), context.sharedArguments.begin(), context.sharedArguments.end());
  execute(words, context.output);
}

void script(const Context& context, const std::string& path) {
  std::ifstream file(path);
  if (!file) throw UsageError(path + ": cannot be read");
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    try {
      runLine(context, line);
    } catch (const Failure& failure) {
      throw Failure(failure.exitCode(), path + ":" + std::to_string(number) + ": " + failure.what());
    }
  }
}

}  // namespace

void addScript(CLI::App& app, Action& chosen) {
  auto path = std::make_shared<std::string>();
  CLI::App* verb = app.add_subcommand("script",
                                      "Run the command lines of a file, up to the first that fails; 'wait SECONDS' "
                                      "pauses, # starts a comment line");
  verb->add_option("file", *path, "One command a line, as on this command line")->required()->type_name("FILE");
  verb->callback([&chosen, path] { chosen = [path](const Context& context) { script(context, *path); }; });
}

}  // namespace sluice::client
