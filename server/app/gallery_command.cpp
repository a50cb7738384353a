#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "advance.h"
#include "command_options.h"
#include "commands.h"
#include "sluice/core/input_error.h"
#include "sluice/encode/frame_encoder.h"
#include "sluice/gl/context.h"
#include "sluice/render/fluid_renderer.h"
#include "sluice/scene/convert.h"
#include "sluice/scene/parameters.h"
#include "sluice/scene/scene.h"

namespace sluice::app {

namespace {

/// The scene that looks and views are shown on, and the moment of it.
constexpr const char* kSampleScene = "dam_break";
constexpr double kSampleSeconds = 0.55;

struct GalleryOptions {
  std::string out = "gallery";
  std::string size = "1280x720";
  std::string only;
  int threads = 0;
};

/// A page of pictures in the making: draws them, and collects the text that shows them.
class Gallery {
 public:
  explicit Gallery(const GalleryOptions& options)
      : options_(options), size_(parseSize(options.size)), context_(gl::Context::create()) {
    std::error_code error;
    std::filesystem::create_directories(options.out, error);
    if (error) throw core::InputError(options.out, "--out", "cannot be made: " + error.message());
  }

  bool wants(const std::string& name) const { return options_.only.empty() || options_.only == name; }

  void writeLine(const std::string& line) { page_ += line + "\n"; }

  /// Draws a scene at a moment of it. Pictures of one source at one moment share its particles.
  void addPicture(const std::string& name, const std::string& caption, const v1::Scene& scene, double seconds) {
    std::fprintf(stderr, "%s\n", name.c_str());
    render::FluidRenderer renderer(*context_);
    const core::Frame frame =
        renderer.render(particlesOf(scene, seconds), scene, scene::toCamera(scene.camera()), size_);
    // Hardly to be told from the lossless picture, at a fifth of its size.
    encode::EncoderSettings settings;
    settings.quality = 93;
    const core::EncodedFrame picture = encode::makeEncoder(settings)->encode(frame);
    const std::filesystem::path file = std::filesystem::path(options_.out) / (name + ".jpg");
    write(file, {picture.bytes.begin(), picture.bytes.end()});
    writeLine("![" + caption + "](" + name + ".jpg)\n\n" + caption + "\n");
  }

  void finish() const { write(std::filesystem::path(options_.out) / "README.md", page_); }

 private:
  const core::ParticleSnapshot& particlesOf(const v1::Scene& scene, double seconds) {
    v1::Scene source;
    source.set_seed(scene.seed());
    if (scene.has_simulation()) *source.mutable_simulation() = scene.simulation();
    if (scene.has_column_and_sheet()) *source.mutable_column_and_sheet() = scene.column_and_sheet();
    if (scene.has_foam()) *source.mutable_foam() = scene.foam();
    const std::string key = source.SerializeAsString() + std::to_string(seconds);
    std::unique_ptr<core::ParticleSnapshot>& snapshot = particles_[key];
    if (snapshot == nullptr) {
      const std::unique_ptr<core::ParticleSource> opened = openSource(scene, options_.threads);
      advanceTo(*opened, seconds);
      snapshot = takeSnapshot(*opened, particles_.size());
    }
    return *snapshot;
  }

  static void write(const std::filesystem::path& file, const std::string& bytes) {
    std::ofstream stream(file, std::ios::binary);
    stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!stream.flush()) throw core::InputError(file.string(), "--out", "cannot be written");
  }

  const GalleryOptions& options_;
  core::ImageSize size_;
  std::unique_ptr<gl::Context> context_;
  std::map<std::string, std::unique_ptr<core::ParticleSnapshot>> particles_;
  std::string page_;
};

/// The words that a look's preset may be, as the schema lists them.
std::vector<std::string> presets() {
  const auto& info = v1::Look::descriptor()->FindFieldByName("preset")->options().GetExtension(v1::info);
  return {info.words().begin(), info.words().end()};
}

std::string withSpaces(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

void addScenes(Gallery& gallery) {
  gallery.writeLine("## Scenes\n\nEach in its own look, at the moment that `playback.poster_seconds` names.\n");
  for (const scene::ShippedScene& shipped : scene::shippedScenes()) {
    if (!gallery.wants(shipped.name)) continue;
    const v1::Scene scene = scene::loadShipped(shipped.name);
    gallery.addPicture(shipped.name, shipped.title + ": " + shipped.description, scene,
                       scene.playback().poster_seconds());
  }
}

void addLooks(Gallery& gallery) {
  gallery.writeLine("## Looks\n\n`--set look.preset=NAME`, on one and the same moment of `" +
                    std::string(kSampleScene) + "`.\n");
  for (const std::string& preset : presets()) {
    const std::string name = "look_" + preset;
    if (!gallery.wants(name)) continue;
    const LiveScene live = loadScene(kSampleScene, {"look.preset=" + preset});
    gallery.addPicture(name, withSpaces(preset), live.scene, kSampleSeconds);
  }
}

void addViews(Gallery& gallery) {
  gallery.writeLine("## Study views\n\n`--set view.NAME={}`; that of the noise with `--set look.noise={}`.\n");
  const google::protobuf::OneofDescriptor& views = *v1::View::descriptor()->FindOneofByName("shows");
  for (int i = 0; i < views.field_count(); ++i) {
    const google::protobuf::FieldDescriptor& view = *views.field(i);
    const std::string name = "view_" + view.name();
    if (view.name() == "picture" || !gallery.wants(name)) continue;
    std::vector<std::string> settings{"view." + view.name() + "={}"};
    // The sample scene has foam of its own, but its water is smooth.
    if (view.name() == "noise") settings.emplace_back("look.noise={}");
    const LiveScene live = loadScene(kSampleScene, settings);
    gallery.addPicture(name, withSpaces(view.name()) + ": " + view.options().GetExtension(v1::info).doc(), live.scene,
                       kSampleSeconds);
  }
}

int makeGallery(const GalleryOptions& options) {
  Gallery gallery(options);
  gallery.writeLine("# Gallery\n\nMade by `./run gallery`; every picture is " + options.size +
                    ", drawn by the program as it stands.\n");
  addScenes(gallery);
  addLooks(gallery);
  addViews(gallery);
  if (options.only.empty()) gallery.finish();
  return 0;
}

}  // namespace

void addGalleryCommand(CLI::App& program, Command& chosen) {
  const auto options = std::make_shared<GalleryOptions>();
  CLI::App& verb = *program.add_subcommand("gallery", "Draw every shipped scene, look and study view to one page");
  verb.add_option("--out", options->out, "The folder to write to")->capture_default_str();
  verb.add_option("--size", options->size, "WIDTHxHEIGHT in pixels")->capture_default_str();
  verb.add_option("--only", options->only, "One picture alone, by its file's name, and no page");
  verb.add_option("--threads", options->threads, "Threads of the solver; 0 is one for each core")
      ->check(CLI::Range(0, 1024));
  verb.callback([options, &chosen] { chosen = [options] { return makeGallery(*options); }; });
}

}  // namespace sluice::app
