#include <filesystem>
#include <fstream>
#include <memory>
#include <ostream>
#include <string>

#include "sluice/client/failure.h"
#include "sluice/client/json.h"
#include "sluice/client/option_values.h"
#include "sluice/client/requests.h"
#include "verbs/verb.h"

namespace sluice::client {

namespace {

struct SnapshotOptions {
  std::string file;
  std::string size = "1280x720";
  std::string camera;
};

/// A file that appears under its name only once it is complete; what stood there before stays until then.
class NewFile {
 public:
  /// Throws RequestError where the file cannot be written.
  explicit NewFile(std::filesystem::path path) : path_(std::move(path)), part_(path_.string() + ".part") {
    if (std::filesystem::is_directory(path_)) throw RequestError(path_.string() + ": is a folder");
    stream_.open(part_, std::ios::binary | std::ios::trunc);
    if (!stream_) throw RequestError(path_.string() + ": cannot be written");
  }
  ~NewFile() {
    std::error_code ignored;  // Once finished there is nothing to remove.
    std::filesystem::remove(part_, ignored);
  }
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  void finish(const std::string& bytes) {
    stream_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    stream_.close();
    std::error_code error;
    if (stream_) std::filesystem::rename(part_, path_, error);
    if (!stream_ || error) throw RequestError(path_.string() + ": cannot be written");
  }

 private:
  std::filesystem::path path_;
  std::filesystem::path part_;
  std::ofstream stream_;
};

void snapshot(const Context& context, const SnapshotOptions& options) {
  const PictureSize size = parseSize(options.size);
  if (!options.camera.empty()) parseCamera(options.camera, {});  // refused before anything is touched
  NewFile file(options.file);

  Connection connection = context.connect();
  v1::ClientMessage message;
  v1::SnapshotRequest& wanted = *message.mutable_snapshot();
  wanted.set_width(size.width);
  wanted.set_height(size.height);
  if (!options.camera.empty()) {
    *wanted.mutable_camera() = parseCamera(options.camera, connection.welcome().scene().camera());
  }
  const v1::ServerMessage reply = request(connection, std::move(message));
  const v1::Frame& frame = reply.frame();
  if (frame.codec() != v1::PNG) {
    throw RequestError("the server sent " + v1::Codec_Name(frame.codec()) + " where a snapshot is PNG");
  }
  file.finish(frame.payload());

  if (context.json) {
    context.output.out << toLine({{"file", options.file},
                                  {"width", frame.width()},
                                  {"height", frame.height()},
                                  {"bytes", frame.payload().size()},
                                  {"simulation_time", frame.simulation_time()}});
  } else {
    context.output.out << options.file << ": " << frame.width() << "x" << frame.height() << ", "
                       << frame.payload().size() << " bytes\n";
  }
}

}  // namespace

void addSnapshot(CLI::App& app, Action& chosen) {
  auto options = std::make_shared<SnapshotOptions>();
  CLI::App* verb = app.add_subcommand("snapshot", "Store one lossless picture");
  verb->add_option("file", options->file, "The PNG file to write")->required()->type_name("FILE");
  verb->add_option("--size", options->size, "Size in pixels")->capture_default_str()->type_name("WxH");
  verb->add_option("--camera", options->camera, "Eye, target and field of view in degrees; else the scene's camera")
      ->type_name("X,Y,Z:X,Y,Z[:FOV]");
  verb->callback([&chosen, options] { chosen = [options](const Context& context) { snapshot(context, *options); }; });
}

}  // namespace sluice::client
