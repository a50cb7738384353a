#include <cstdio>
#include <memory>

#include <CLI/CLI.hpp>

#include "commands.h"
#include "json.h"
#include "sluice/scene/looks.h"
#include "sluice/scene/parameters.h"
#include "sluice/scene/scene.h"

namespace sluice::app {

void addScenesCommand(CLI::App& program, Command& chosen) {
  const auto json = std::make_shared<bool>(false);
  CLI::App& verb = *program.add_subcommand("scenes", "List the shipped scenes");
  verb.add_flag("--json", *json, "Print them as one JSON object");
  verb.callback([json, &chosen] {
    chosen = [json] {
      Json list = Json::array();
      for (const scene::ShippedScene& shipped : scene::shippedScenes()) {
        if (*json) {
          list.push_back({{"name", shipped.name}, {"title", shipped.title}, {"description", shipped.description}});
        } else {
          std::printf("%-20s %s\n", shipped.name.c_str(), shipped.title.c_str());
        }
      }
      if (*json) std::printf("%s\n", Json{{"scenes", list}}.dump().c_str());
      return 0;
    };
  });
}

void addLooksCommand(CLI::App& program, Command& chosen) {
  const auto json = std::make_shared<bool>(false);
  CLI::App& verb = *program.add_subcommand("looks", "List the shipped looks, which look.preset takes");
  verb.add_flag("--json", *json, "Print them as one JSON object");
  verb.callback([json, &chosen] {
    chosen = [json] {
      Json list = Json::array();
      for (const scene::ShippedLook& shipped : scene::shippedLooks()) {
        if (*json) {
          list.push_back({{"name", shipped.name}, {"description", shipped.description}});
        } else {
          std::printf("%-20s %s\n", shipped.name.c_str(), shipped.description.c_str());
        }
      }
      if (*json) std::printf("%s\n", Json{{"looks", list}}.dump().c_str());
      return 0;
    };
  });
}

void addParametersCommand(CLI::App& program, Command& chosen) {
  CLI::App& verb = *program.add_subcommand("parameters", "Print the reference of all fields that --set takes");
  verb.callback([&chosen] {
    chosen = [] {
      std::fputs(scene::parameterReferenceMarkdown().c_str(), stdout);
      return 0;
    };
  });
}

}  // namespace sluice::app
