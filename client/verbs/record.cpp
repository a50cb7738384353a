#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <utility>

#include "sluice/client/failure.h"
#include "sluice/client/json.h"
#include "sluice/client/option_values.h"
#include "sluice/client/requests.h"
#include "sluice/media/mp4_writer.h"
#include "verbs/verb.h"

namespace sluice::client {

namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

struct RecordOptions {
  std::string out;
  double seconds = 5;
  double framesPerSecond = 25;
  std::string size = "1280x720";
  std::string camera;
  std::uint32_t quality = 90;
};

std::atomic<bool> interrupted = false;

/// Lets an interrupt end the recording instead of the program, for as long as it lives.
class InterruptGuard {
 public:
  InterruptGuard() : before_(std::signal(SIGINT, [](int) { interrupted = true; })) { interrupted = false; }
  ~InterruptGuard() { std::signal(SIGINT, before_); }
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

 private:
  void (*before_)(int);
};

v1::ClientMessage controlMessage(v1::Control::Action action, double untilSeconds = 0) {
  v1::ClientMessage message;
  message.mutable_control()->set_action(action);
  message.mutable_control()->set_until_seconds(untilSeconds);
  return message;
}

/// Halts a run that plays, and lets it go on at the end, however the recording ends.
class Halt {
 public:
  Halt(Connection& connection, bool playing) : connection_(connection), playing_(playing) {
    if (playing_) request(connection_, controlMessage(v1::Control::PAUSE));
  }
  ~Halt() {
    if (!playing_) return;
    try {
      connection_.send(controlMessage(v1::Control::PLAY));
    } catch (const Failure&) {
      // The server has gone; there is nothing to let go on.
    }
  }
  Halt(const Halt&) = delete;
  Halt& operator=(const Halt&) = delete;

 private:
  Connection& connection_;
  bool playing_;
};

/// Where pictures of one moment after the other go.
class Recording {
 public:
  virtual ~Recording() = default;

  /// Takes a frame that comes while the server is on its way to `time`, where it is of use.
  virtual void offer(Connection& /*connection*/, const v1::Frame& /*frame*/, double /*time*/) {}

  /// The picture at `time`, which the server has reached. False where an interrupt came first.
  virtual bool take(Connection& connection, double time) = 0;
  virtual std::uint64_t frames() const = 0;
  virtual void finish() = 0;
};

/// Lossless pictures in a folder: frame_0000.png and so on.
class PictureFolder final : public Recording {
 public:
  PictureFolder(fs::path folder, PictureSize size, std::optional<v1::Camera> camera)
      : folder_(std::move(folder)), size_(size), camera_(std::move(camera)) {
    std::error_code error;
    fs::create_directories(folder_, error);
    if (error) throw RequestError(folder_.string() + ": cannot be made: " + error.message());
  }

  bool take(Connection& connection, double /*time*/) override {
    v1::ClientMessage message;
    message.mutable_snapshot()->set_width(size_.width);
    message.mutable_snapshot()->set_height(size_.height);
    if (camera_) *message.mutable_snapshot()->mutable_camera() = *camera_;
    const std::string bytes = request(connection, std::move(message)).frame().payload();
    char name[32];
    std::snprintf(name, sizeof name, "frame_%04llu.png", static_cast<unsigned long long>(frames_));
    std::ofstream file(folder_ / name, std::ios::binary | std::ios::trunc);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    file.close();
    if (!file) throw RequestError((folder_ / name).string() + ": cannot be written");
    ++frames_;
    return true;
  }
  std::uint64_t frames() const override { return frames_; }
  void finish() override {}

 private:
  fs::path folder_;
  PictureSize size_;
  std::optional<v1::Camera> camera_;
  std::uint64_t frames_ = 0;
};

/// The server's own stream of H.264, one frame for each time, put into a file as it comes.
class Mp4Recording final : public Recording {
 public:
  Mp4Recording(Connection& connection, const RecordOptions& options, PictureSize size,
               const std::optional<v1::Camera>& camera)
      : file_(options.out, {.width = static_cast<int>(size.width),
                            .height = static_cast<int>(size.height),
                            .framesPerSecond = options.framesPerSecond}) {
    if (camera) {
      v1::ClientMessage message;
      *message.mutable_set_camera()->mutable_camera() = *camera;
      connection.send(std::move(message));
    }
    v1::ClientMessage message;
    v1::SetView& view = *message.mutable_set_view();
    view.set_width(size.width);
    view.set_height(size.height);
    view.add_codecs(v1::H264);
    view.set_mode(v1::FIXED_QUALITY);
    view.set_quality(options.quality);
    view.set_no_still(true);
    viewSequence_ = connection.send(std::move(message));
  }

  void offer(Connection& connection, const v1::Frame& frame, double time) override {
    taken_ = takeFrame(connection, frame, time) || taken_;
  }

  bool take(Connection& connection, double time) override {
    while (!taken_ && !interrupted) {
      const auto message = connection.receive(Connection::Clock::now() + 200ms);
      if (!message) continue;
      if (message->has_error() && message->in_reply_to() == viewSequence_) {
        throw RequestError(describe(message->error()));
      }
      if (message->has_frame()) offer(connection, message->frame(), time);
    }
    return std::exchange(taken_, false);
  }
  std::uint64_t frames() const override { return file_.frames(); }
  void finish() override { file_.finish(); }

 private:
  bool takeFrame(Connection& connection, const v1::Frame& frame, double time) {
    v1::ClientMessage ack;
    ack.mutable_frame_ack()->set_frame_id(frame.frame_id());
    connection.send(std::move(ack));
    // Frames of another moment, as after a change of the scene, have no place in the file; what builds on them neither.
    const bool wanted = !taken_ && frame.simulation_time() == time && frame.reflects_sequence() >= viewSequence_;
    if (wanted && (frame.keyframe() || !broken_)) {
      const auto* bytes = reinterpret_cast<const std::uint8_t*>(frame.payload().data());
      file_.write({bytes, frame.payload().size()}, frame.keyframe());
      broken_ = false;
      return true;
    }
    if (!broken_ || wanted) {
      v1::ClientMessage request;
      request.mutable_keyframe();
      connection.send(std::move(request));
    }
    broken_ = true;
    return false;
  }

  media::Mp4Writer file_;
  std::uint64_t viewSequence_ = 0;
  bool broken_ = false;
  bool taken_ = false;
};

/// Brings the server's run to a time, however long that takes. False where an interrupt came first.
bool stepTo(Connection& connection, double time, Recording& recording) {
  const std::uint64_t sequence = connection.send(controlMessage(v1::Control::STEP, time));
  while (!interrupted) {
    const auto message = connection.receive(Connection::Clock::now() + 200ms);
    if (message && message->has_frame()) recording.offer(connection, message->frame(), time);
    if (!message || message->in_reply_to() != sequence) continue;
    if (message->has_error()) throw RequestError(describe(message->error()));
    return true;
  }
  return false;
}

std::unique_ptr<Recording> openRecording(Connection& connection, const RecordOptions& options) {
  const PictureSize size = parseSize(options.size);
  std::optional<v1::Camera> camera;
  if (!options.camera.empty()) camera = parseCamera(options.camera, connection.welcome().scene().camera());
  if (options.out.ends_with(".mp4")) return std::make_unique<Mp4Recording>(connection, options, size, camera);
  return std::make_unique<PictureFolder>(options.out, size, camera);
}

void takeAll(Connection& connection, const RecordOptions& options, Recording& recording, double begin) {
  const auto count = static_cast<std::uint64_t>(std::floor(options.seconds * options.framesPerSecond + 1e-9)) + 1;
  for (std::uint64_t k = 0; k < count; ++k) {
    const double time = k == 0 ? begin : begin + static_cast<double>(k) / options.framesPerSecond;
    if (k > 0 && !stepTo(connection, time, recording)) return;
    if (!recording.take(connection, time)) return;
  }
}

void record(const Context& context, const RecordOptions& options) {
  parseSize(options.size);  // refused before anything is touched
  if (!options.camera.empty()) parseCamera(options.camera, {});
  const InterruptGuard guard;
  Connection connection = context.connect();
  const Halt halt(connection, !currentStats(connection).paused());
  const double begin = currentStats(connection).simulation_time();

  std::unique_ptr<Recording> recording = openRecording(connection, options);
  try {
    takeAll(connection, options, *recording, begin);
  } catch (const ConnectionError&) {
    // What was recorded is kept.
    if (recording->frames() > 0) recording->finish();
    context.output.err << "sluice: " << options.out << " ends after " << recording->frames() << " frames\n";
    throw;
  }
  if (recording->frames() > 0) recording->finish();
  if (context.json) {
    context.output.out << toLine({{"file", options.out},
                                  {"frames", recording->frames()},
                                  {"frames_per_second", options.framesPerSecond},
                                  {"begin_seconds", begin}});
  } else {
    context.output.out << options.out << ": " << recording->frames() << " frames from " << begin << " s on\n";
  }
}

}  // namespace

void addRecord(CLI::App& app, Action& chosen) {
  auto options = std::make_shared<RecordOptions>();
  CLI::App* verb = app.add_subcommand(
      "record", "Step through simulated time and store each picture of it: exact times, however long they take");
  verb->add_option("out", options->out, "An .mp4 file, or a folder for lossless pictures")
      ->required()
      ->type_name("FILE|DIR");
  verb->add_option("--seconds", options->seconds, "Simulated time to record")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 1e6));
  verb->add_option("--fps", options->framesPerSecond, "Pictures per simulated second")
      ->capture_default_str()
      ->check(CLI::Range(0.01, 10000.0));
  verb->add_option("--size", options->size, "Size in pixels")->capture_default_str()->type_name("WxH");
  verb->add_option("--camera", options->camera, "Eye, target and field of view in degrees; else the scene's camera")
      ->type_name("X,Y,Z:X,Y,Z[:FOV]");
  verb->add_option("--quality", options->quality, "Of an .mp4 file")
      ->capture_default_str()
      ->check(CLI::Range(1U, 100U));
  verb->callback([&chosen, options] { chosen = [options](const Context& context) { record(context, *options); }; });
}

}  // namespace sluice::client
