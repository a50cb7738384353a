#include <cstdio>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "command_options.h"
#include "commands.h"
#include "json.h"
#include "sluice/render/plan_picture.h"
#include "sluice/scene/convert.h"

namespace sluice::app {

namespace {

struct PlanOptions {
  SceneOptions scene;
  std::string size = "1024x768";
  std::string camera;
};

std::string join(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

void printText(const char* title, const core::Plan& plan) {
  std::printf("%s\n", title);
  for (const core::PlannedStage& stage : plan.stages) {
    std::printf("  %-24s %s -> %s\n", stage.name.c_str(), join(stage.reads).c_str(), join(stage.writes).c_str());
  }
  std::uint64_t total = 0;
  for (const core::PlannedBuffer& buffer : plan.buffers) {
    std::printf("  buffer %-17s %12llu bytes\n", buffer.name.c_str(), static_cast<unsigned long long>(buffer.bytes));
    total += buffer.bytes;
  }
  if (total > 0) std::printf("  all buffers %25llu bytes\n", static_cast<unsigned long long>(total));
  for (const core::LeftOut& entry : plan.leftOut) {
    std::printf("  left out: %s: %s\n", entry.name.c_str(), entry.reason.c_str());
  }
}

int printPlan(const PlanOptions& options) {
  const LiveScene live = options.scene.load();
  const std::unique_ptr<core::ParticleSource> source = openSource(live.scene, options.scene.threads);
  core::Camera camera = scene::toCamera(live.scene.camera());
  if (!options.camera.empty()) camera = parseCamera(options.camera, camera);

  const core::Plan steps = source->plan();
  const core::Plan frame = render::planPicture(*source->snapshot(), live.scene, camera, parseSize(options.size));
  if (options.scene.json) {
    std::printf("%s\n", Json{{"steps", toJson(steps)}, {"frame", toJson(frame)}}.dump().c_str());
  } else {
    printText("a step", steps);
    printText("a frame", frame);
  }
  return 0;
}

}  // namespace

void addPlanCommand(CLI::App& program, Command& chosen) {
  const auto options = std::make_shared<PlanOptions>();
  CLI::App& verb =
      *program.add_subcommand("plan", "Print what a scene runs, what it leaves out and why, and its buffers");
  addSceneOptions(verb, options->scene, "", true);
  verb.add_option("--size", options->size, "WIDTHxHEIGHT of the picture in pixels")->capture_default_str();
  verb.add_option("--camera", options->camera, "x,y,z:x,y,z[:fovDegrees]: eye, target, vertical field of view");
  verb.callback([options, &chosen] { chosen = [options] { return printPlan(*options); }; });
}

}  // namespace sluice::app
