#include <filesystem>
#include <fstream>
#include <memory>
#include <ostream>
#include <sstream>
#include <string>

#include "sluice/client/failure.h"
#include "sluice/client/json.h"
#include "sluice/client/requests.h"
#include "verbs/verb.h"

namespace sluice::client {

namespace {

/// Shipped scenes have plain names, so what looks like a path is one.
bool isFile(const std::string& scene) { return scene.find('/') != std::string::npos || scene.ends_with(".textproto"); }

std::string readFile(const std::string& path, std::uint32_t maxBytes) {
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  if (error) throw UsageError(path + ": cannot be read: " + error.message());
  if (maxBytes > 0 && size > maxBytes) {
    throw UsageError(path + ": holds " + std::to_string(size) + " bytes; the server takes at most " +
                     std::to_string(maxBytes));
  }
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) throw UsageError(path + ": cannot be read");
  return text.str();
}

void load(const Context& context, const std::string& scene) {
  if (isFile(scene) && !std::filesystem::is_regular_file(scene)) throw UsageError(scene + ": there is no such file");
  Connection connection = context.connect();
  v1::ClientMessage message;
  if (isFile(scene)) {
    message.mutable_load_scene()->set_text(readFile(scene, connection.welcome().limits().max_message_bytes()));
  } else {
    message.mutable_load_scene()->set_name(scene);
  }
  std::string title;
  request(connection, std::move(message), [&](const v1::ServerMessage& other) {
    if (other.has_scene_changed()) title = other.scene_changed().scene().title();
  });
  const v1::Stats stats = currentStats(connection);
  if (context.json) {
    context.output.out << toLine({{"scene", scene}, {"title", title}, {"particles", stats.particles()}});
  } else {
    context.output.out << "loaded " << scene << ", " << stats.particles() << " particles\n";
  }
}

}  // namespace

void addLoad(CLI::App& app, Action& chosen) {
  auto scene = std::make_shared<std::string>();
  CLI::App* verb = app.add_subcommand("load", "Run another scene: one of the server's, or a file of your own");
  verb->add_option("scene", *scene, "A name that `info` lists, or a .textproto file")->required()->type_name("SCENE");
  verb->callback([&chosen, scene] { chosen = [scene](const Context& context) { load(context, *scene); }; });
}

}  // namespace sluice::client
