#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>

#include "advance.h"
#include "command_options.h"
#include "commands.h"
#include "json.h"
#include "movie.h"
#include "sluice/core/input_error.h"
#include "sluice/encode/frame_encoder.h"
#include "sluice/gl/context.h"
#include "sluice/render/fluid_renderer.h"
#include "sluice/scene/convert.h"
#include "statistics.h"

namespace sluice::app {

namespace {

struct RenderOptions {
  SceneOptions scene;
  std::string out;
  std::string size = "1024x768";
  std::string camera;
  std::string frames;
  double framesPerSecond = 25;
  double time = 0;
  int quality = 92;
  int repeat = 0;
};

struct Shot {
  core::ImageSize size;
  core::Camera camera;
  const v1::Scene* scene = nullptr;
};

core::Frame draw(render::FluidRenderer& renderer, const Shot& shot, const core::ParticleSnapshot& particles) {
  return renderer.render(particles, *shot.scene, shot.camera, shot.size);
}

/// Draws frames FIRST to LAST of an animation, each at its exact time.
void drawSequence(render::FluidRenderer& renderer, const Shot& shot, core::ParticleSource& source, FrameRange range,
                  double framesPerSecond, Movie& movie) {
  for (int k = range.first; k <= range.last; ++k) {
    advanceOnto(source, k / framesPerSecond);
    const auto particles = takeSnapshot(source, static_cast<std::uint64_t>(k - range.first) + 1);
    movie.write(k, draw(renderer, shot, *particles));
  }
  movie.finish();
}

struct Timing {
  double medianMilliseconds = 0;
  core::StageTimes passes;
};

/// Draws again and again while the camera circles its target by a tenth of a degree a frame, so that nothing can be
/// reused that a moving camera would not allow.
Timing timeFrames(render::FluidRenderer& renderer, Shot shot, const core::ParticleSnapshot& particles, int repeat) {
  using Clock = std::chrono::steady_clock;
  std::vector<double> milliseconds;
  std::vector<core::StageTimes> passes;
  const Eigen::AngleAxisf turn(0.1F * std::numbers::pi_v<float> / 180.0F, shot.camera.up.normalized());
  for (int k = 0; k < repeat; ++k) {
    shot.camera.eye = shot.camera.target + turn * (shot.camera.eye - shot.camera.target);
    const auto start = Clock::now();
    const core::Frame frame = draw(renderer, shot, particles);
    milliseconds.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
    passes.push_back(frame.tag.stages);
  }
  return {median(std::move(milliseconds)), medianStageTimes(passes)};
}

void printText(const Timing& timing, const core::Plan& plan) {
  std::printf("%.2f ms a frame (median)\n", timing.medianMilliseconds);
  for (const core::StageTime& pass : timing.passes)
    std::printf("  %-28s %8.3f ms\n", pass.name.c_str(), pass.milliseconds);
  for (const core::LeftOut& entry : plan.leftOut)
    std::printf("  left out: %s: %s\n", entry.name.c_str(), entry.reason.c_str());
}

int renderScene(const RenderOptions& options) {
  const LiveScene live = options.scene.load();
  const std::unique_ptr<core::ParticleSource> source = openSource(live.scene, options.scene.threads);

  Shot shot{parseSize(options.size), scene::toCamera(live.scene.camera()), &live.scene};
  if (!options.camera.empty()) shot.camera = parseCamera(options.camera, shot.camera);
  const std::optional<FrameRange> range =
      options.frames.empty() ? std::nullopt : std::optional(parseFrameRange(options.frames));
  if (range && options.out.empty())
    throw core::InputError("", "--frames", "needs --out, the folder or the .mp4 file to write");
  // Where it cannot be written, nothing need be drawn.
  const std::unique_ptr<Movie> movie =
      range ? openMovie(options.out, shot.size, options.framesPerSecond, options.quality) : nullptr;

  const std::unique_ptr<gl::Context> context = gl::Context::create();
  render::FluidRenderer renderer(*context);

  if (range) {
    drawSequence(renderer, shot, *source, *range, options.framesPerSecond, *movie);
  } else {
    advanceTo(*source, options.time, live.scene, renderer);
  }
  const std::uint64_t drawn = range ? static_cast<std::uint64_t>(range->last - range->first) + 1 : 0;
  const std::unique_ptr<core::ParticleSnapshot> particles = takeSnapshot(*source, drawn + 1);
  // Of one picture alone the first drawing is timed, set-up included.
  Timing timing = timeFrames(renderer, shot, *particles, range ? 0 : 1);
  if (!range && !options.out.empty()) encode::writePng(draw(renderer, shot, *particles), options.out);
  if (options.repeat > 0) timing = timeFrames(renderer, shot, *particles, options.repeat);

  if (options.scene.json) {
    const Json json = {{"particles", particles->size()},     {"renderer", context->rendererName()},
                       {"simulation_time", particles->time}, {"width", shot.size.width},
                       {"height", shot.size.height},         {"frame_milliseconds_median", timing.medianMilliseconds},
                       {"passes", toJson(timing.passes)},    {"left_out", toJson(renderer.plan().leftOut)}};
    std::printf("%s\n", json.dump().c_str());
  } else if (!range) {
    printText(timing, renderer.plan());
  }
  return 0;
}

}  // namespace

void addRenderCommand(CLI::App& program, Command& chosen) {
  const auto options = std::make_shared<RenderOptions>();
  CLI::App& verb = *program.add_subcommand("render", "Draw a scene to PNG or MP4 files, without any network");
  addSceneOptions(verb, options->scene, "", true);
  verb.add_option("--out", options->out, "The picture, or with --frames the folder or .mp4 file, to write");
  verb.add_option("--size", options->size, "WIDTHxHEIGHT in pixels")->capture_default_str();
  verb.add_option("--camera", options->camera, "x,y,z:x,y,z[:fovDegrees]: eye, target, vertical field of view");
  verb.add_option("--time", options->time, "Simulated time to draw, s")
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str();
  verb.add_option("--frames", options->frames, "FIRST:LAST: draw these frames of an animation");
  verb.add_option("--fps", options->framesPerSecond, "Frames per simulated second, with --frames")
      ->check(CLI::Range(0.01, 10000.0))
      ->capture_default_str();
  verb.add_option("--quality", options->quality, "Of an .mp4 file; from 90 on hard to tell from the pictures")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  verb.add_option("--repeat", options->repeat, "Draw this many times with a slightly moved camera and time it")
      ->check(CLI::Range(0, 100000));
  verb.callback([options, &chosen] { chosen = [options] { return renderScene(*options); }; });
}

}  // namespace sluice::app
