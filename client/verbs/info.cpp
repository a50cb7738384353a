#include <ostream>

#include <google/protobuf/util/json_util.h>

#include "sluice/client/failure.h"
#include "sluice/client/report.h"
#include "sluice/client/requests.h"
#include "verbs/verb.h"

namespace sluice::client {

namespace {

std::vector<std::string> codecNames(const v1::Welcome& welcome) {
  std::vector<std::string> names;
  for (const int codec : welcome.codecs()) names.push_back(v1::Codec_Name(static_cast<v1::Codec>(codec)));
  return names;
}

/// The scene with its fields under the names that `set` takes.
Json sceneJson(const v1::Scene& scene) {
  google::protobuf::util::JsonPrintOptions options;
  options.preserve_proto_field_names = true;
  std::string json;
  const auto status = google::protobuf::util::MessageToJsonString(scene, &json, options);
  if (!status.ok()) throw RequestError("the server's scene cannot be shown: " + std::string(status.message()));
  return Json::parse(json);
}

void printJson(std::ostream& out, const v1::Welcome& welcome, const v1::Stats& stats) {
  const v1::Limits& limits = welcome.limits();
  Json scenes = Json::array();
  for (const v1::SceneEntry& entry : welcome.scenes()) {
    scenes.push_back({{"name", entry.name()}, {"title", entry.title()}});
  }
  out << toLine({{"server_version", welcome.server_version()},
                 {"protocol_version", welcome.protocol_version()},
                 {"renderer", welcome.renderer()},
                 {"scene_name", welcome.scene_name()},
                 {"title", welcome.scene().title()},
                 {"particles", stats.particles()},
                 {"paused", stats.paused()},
                 {"stats", statsJson(stats)},
                 {"limits",
                  {{"max_width", limits.max_width()},
                   {"max_height", limits.max_height()},
                   {"max_message_bytes", limits.max_message_bytes()},
                   {"frame_window", limits.frame_window()},
                   {"max_rate", limits.max_rate()}}},
                 {"codecs", codecNames(welcome)},
                 {"scenes", scenes},
                 {"scene", sceneJson(welcome.scene())}});
}

void printText(std::ostream& out, const v1::Welcome& welcome, const v1::Stats& stats) {
  const v1::Limits& limits = welcome.limits();
  out << "server       " << welcome.server_version() << ", protocol " << welcome.protocol_version() << '\n'
      << "renderer     " << welcome.renderer() << '\n'
      << "scene        " << (welcome.scene_name().empty() ? "(not a shipped one)" : welcome.scene_name()) << ": "
      << welcome.scene().title() << '\n'
      << "particles    " << stats.particles() << '\n'
      << "state        " << stateText(stats) << " at " << formatRounded(stats.simulation_time()) << " s, "
      << stats.steps() << " steps\n"
      << "pictures     at most " << limits.max_width() << "x" << limits.max_height() << ", "
      << formatRounded(limits.max_rate()) << " per second, as";
  for (const std::string& codec : codecNames(welcome)) out << ' ' << codec;
  out << "\nscenes\n";
  for (const v1::SceneEntry& entry : welcome.scenes()) {
    out << (entry.name() == welcome.scene_name() ? "  * " : "    ") << entry.name() << ": " << entry.title() << '\n';
  }
}

void info(const Context& context) {
  Connection connection = context.connect();
  const v1::Stats stats = currentStats(connection);
  (context.json ? printJson : printText)(context.output.out, connection.welcome(), stats);
}

}  // namespace

void addInfo(CLI::App& app, Action& chosen) {
  app.add_subcommand("info", "What runs on the server, and what it can do")->callback([&chosen] { chosen = info; });
}

}  // namespace sluice::client
