#include "sluice/client/stream_benchmark.h"

#include <algorithm>
#include <chrono>
#include <numbers>
#include <string_view>
#include <tuple>
#include <utility>

#include "sluice/client/delay_meter.h"
#include "sluice/client/failure.h"
#include "sluice/client/frame_decoder.h"
#include "sluice/client/peak_signal_to_noise.h"
#include "sluice/client/requests.h"

namespace sluice::client {

namespace {

using Clock = Connection::Clock;
using Seconds = std::chrono::duration<double>;

/// Cameras come as often as a pointer's movements on a common screen.
constexpr std::chrono::microseconds kCameraInterval{16'667};

/// A turn in six seconds: every pixel changes from frame to frame, as under an eager hand.
constexpr double kRadiansPerSecond = 2 * std::numbers::pi / 6;

/// How long the frames for the last cameras are waited for.
constexpr std::chrono::seconds kAftermath{2};

/// The protocol's name of the stage that is not drawing.
constexpr std::string_view kEncodeStage = "encode";

double millisecondsBetween(Clock::time_point begin, Clock::time_point end) {
  return std::chrono::duration<double, std::milli>(end - begin).count();
}

Clock::time_point after(Clock::time_point begin, double seconds) {
  return begin + std::chrono::duration_cast<Clock::duration>(Seconds(seconds));
}

/// All of the server's work on a frame but encoding it.
double drawMilliseconds(const v1::Frame& frame) {
  double sum = 0;
  for (const v1::StageTime& stage : frame.stages()) {
    if (stage.name() != kEncodeStage) sum += stage.milliseconds();
  }
  return sum;
}

class StreamBenchmark {
 public:
  StreamBenchmark(Connection& connection, const StreamBenchmarkOptions& options)
      : connection_(connection), options_(options), camera_(connection.welcome().scene().camera()) {}

  StreamBenchmarkResult run() {
    if (options_.slowBytesPerSecond > 0) connection_.limitRate(options_.slowBytesPerSecond);
    openView();
    const Clock::time_point warmUpEnd = Clock::now() + connection_.timeout();
    while (!takeMessage(warmUpEnd)) {
      if (Clock::now() >= warmUpEnd) throw RequestError("the server sends no frame");
    }

    begin_ = Clock::now();
    result_ = {};
    nextCamera_ = begin_;
    const Clock::time_point end = after(begin_, options_.seconds);
    for (Clock::time_point now = begin_; now < end; now = Clock::now()) {
      if (cameraDue(now)) sendCamera(now);
      takeMessage(options_.orbit && !options_.inTurn ? std::min(nextCamera_, end) : end);
    }
    result_.seconds = Seconds(Clock::now() - begin_).count();

    // Delays of inputs that are still under way count; the frames that show them lie outside the measured time.
    const auto counted = std::pair(result_.frames, result_.payloadBytes);
    const Clock::time_point aftermathEnd = Clock::now() + kAftermath;
    while (delays_.waiting() && Clock::now() < aftermathEnd) takeMessage(aftermathEnd);
    std::tie(result_.frames, result_.payloadBytes) = counted;
    result_.inputToDecodedMilliseconds = delays_.milliseconds();
    result_.longestDelayFrames = delays_.mostFrames();
    // What the comparison receives is not measured.
    StreamBenchmarkResult measured = result_;
    measured.psnrDecibels = measureQuality();
    return measured;
  }

 private:
  void openView() {
    v1::ClientMessage message;
    v1::SetView& view = *message.mutable_set_view();
    view.set_width(options_.size.width);
    view.set_height(options_.size.height);
    view.add_codecs(options_.codec);
    view.set_quality(options_.quality);
    view.set_mode(options_.mode);
    view.set_kilobits_per_second(options_.kilobitsPerSecond);
    view.set_no_still(true);
    connection_.send(std::move(message));
  }

  bool cameraDue(Clock::time_point now) const {
    if (!options_.orbit) return false;
    return options_.inTurn ? !delays_.waiting() : now >= nextCamera_;
  }

  void sendCamera(Clock::time_point now) {
    v1::ClientMessage message;
    *message.mutable_set_camera()->mutable_camera() =
        orbited(camera_, kRadiansPerSecond * Seconds(now - begin_).count());
    const Clock::time_point sent = Clock::now();
    delays_.sent(connection_.send(std::move(message)), sent);
    // After a long frame the missed cameras are left out rather than sent in a burst.
    nextCamera_ = std::max(nextCamera_ + kCameraInterval, now);
  }

  /// Compares pictures from around the orbit with lossless ones, as long as nothing moves between the two.
  std::vector<double> measureQuality() {
    const bool paused =
        connection_.latestStats() ? connection_.latestStats()->paused() : connection_.welcome().paused();
    std::vector<double> decibels;
    if (!paused) return decibels;
    constexpr int kPictures = 5;
    for (int i = 0; i < kPictures; ++i) {
      const v1::Camera camera = orbited(camera_, 2 * std::numbers::pi * i / kPictures);
      if (const std::optional<Picture> picture = pictureFrom(camera)) {
        if (const auto psnr = peakSignalToNoise(*picture, losslessFrom(camera))) {
          decibels.push_back(*psnr);
        }
      }
    }
    return decibels;
  }

  /// The stream's picture from this camera; none when it does not come in the connection's time.
  std::optional<Picture> pictureFrom(const v1::Camera& camera) {
    v1::ClientMessage message;
    *message.mutable_set_camera()->mutable_camera() = camera;
    const std::uint64_t sequence = connection_.send(std::move(message));
    const Clock::time_point deadline = Clock::now() + connection_.timeout();
    while (Clock::now() < deadline) {
      if (takeMessage(deadline) && reflected_ >= sequence) return *picture_;
    }
    return std::nullopt;
  }

  Picture losslessFrom(const v1::Camera& camera) {
    v1::ClientMessage message;
    v1::SnapshotRequest& wanted = *message.mutable_snapshot();
    wanted.set_width(options_.size.width);
    wanted.set_height(options_.size.height);
    *wanted.mutable_camera() = camera;
    const v1::ServerMessage reply = request(connection_, std::move(message), [this](const v1::ServerMessage& other) {
      if (other.has_frame()) takeFrame(other.frame());
    });
    return FrameDecoder().decode(reply.frame());
  }

  /// Handles the next message, if one comes in time; whether it was a frame.
  bool takeMessage(Clock::time_point deadline) {
    const std::optional<v1::ServerMessage> message = connection_.receive(deadline);
    if (!message) return false;
    if (message->has_error()) throw RequestError(describe(message->error()));
    if (!message->has_frame()) return false;
    takeFrame(message->frame());
    return true;
  }

  /// Only the mode that may give up size for speed has smaller pictures than asked for.
  void checkFrame(const v1::Frame& frame) const {
    const v1::Codec wanted = options_.mode == v1::LOSSLESS ? v1::PNG : options_.codec;
    if (frame.codec() != wanted) {
      throw RequestError("the server sends " + v1::Codec_Name(frame.codec()) + ", not " + v1::Codec_Name(wanted));
    }
    const bool whole = frame.width() == options_.size.width && frame.height() == options_.size.height;
    const bool smaller = frame.width() <= options_.size.width && frame.height() <= options_.size.height;
    if (!whole && !(smaller && options_.mode == v1::AUTOMATIC)) {
      throw RequestError("the server sends pictures of another size than asked for");
    }
  }

  void takeFrame(const v1::Frame& frame) {
    checkFrame(frame);
    const Clock::time_point received = Clock::now();
    picture_ = &decoder_.decode(frame);
    const Clock::time_point decoded = Clock::now();
    reflected_ = frame.reflects_sequence();
    const std::optional<double> delay = delays_.decoded(reflected_, decoded);
    const double draw = drawMilliseconds(frame);
    result_.drawMilliseconds.push_back(draw);
    if (delay) result_.besideDrawingMilliseconds.push_back(*delay - draw);
    if (delay && frame.response_milliseconds() > 0) {
      result_.responseMilliseconds.push_back(frame.response_milliseconds());
      result_.networkAndDecodeMilliseconds.push_back(*delay - frame.response_milliseconds());
    }

    v1::ClientMessage message;
    message.mutable_frame_ack()->set_frame_id(frame.frame_id());
    connection_.send(std::move(message));

    ++result_.frames;
    result_.payloadBytes += frame.payload().size();
    result_.decodeMilliseconds.push_back(millisecondsBetween(received, decoded));
    for (const v1::StageTime& stage : frame.stages()) stageNamed(stage.name()).push_back(stage.milliseconds());
  }

  std::vector<double>& stageNamed(const std::string& name) {
    auto& stages = result_.stages;
    const auto known = std::find_if(stages.begin(), stages.end(), [&](const auto& s) { return s.name == name; });
    return known != stages.end() ? known->milliseconds : stages.emplace_back(StageSamples{name, {}}).milliseconds;
  }

  Connection& connection_;
  const StreamBenchmarkOptions& options_;
  const v1::Camera camera_;
  FrameDecoder decoder_;
  const Picture* picture_ = nullptr;  ///< The decoder's newest.
  std::uint64_t reflected_ = 0;       ///< The newest message that it shows.
  DelayMeter delays_;
  StreamBenchmarkResult result_;
  Clock::time_point begin_;
  Clock::time_point nextCamera_;
};

}  // namespace

StreamBenchmarkResult benchmarkStream(Connection& connection, const StreamBenchmarkOptions& options) {
  return StreamBenchmark(connection, options).run();
}

}  // namespace sluice::client
