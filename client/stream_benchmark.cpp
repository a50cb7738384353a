#include "sluice/client/stream_benchmark.h"

#include <algorithm>
#include <chrono>
#include <numbers>
#include <tuple>
#include <utility>

#include "sluice/client/delay_meter.h"
#include "sluice/client/failure.h"
#include "sluice/client/frame_decoder.h"
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

double millisecondsBetween(Clock::time_point begin, Clock::time_point end) {
  return std::chrono::duration<double, std::milli>(end - begin).count();
}

Clock::time_point after(Clock::time_point begin, double seconds) {
  return begin + std::chrono::duration_cast<Clock::duration>(Seconds(seconds));
}

class StreamBenchmark {
 public:
  StreamBenchmark(Connection& connection, const StreamBenchmarkOptions& options)
      : connection_(connection), options_(options), camera_(connection.welcome().scene().camera()) {}

  StreamBenchmarkResult run() {
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
      if (options_.orbit && now >= nextCamera_) sendCamera(now);
      takeMessage(options_.orbit ? std::min(nextCamera_, end) : end);
    }
    result_.seconds = Seconds(Clock::now() - begin_).count();

    // Delays of inputs that are still under way count; the frames that show them lie outside the measured time.
    const auto counted = std::pair(result_.frames, result_.payloadBytes);
    const Clock::time_point aftermathEnd = Clock::now() + kAftermath;
    while (delays_.waiting() && Clock::now() < aftermathEnd) takeMessage(aftermathEnd);
    std::tie(result_.frames, result_.payloadBytes) = counted;
    result_.inputToDecodedMilliseconds = delays_.milliseconds();
    return std::move(result_);
  }

 private:
  void openView() {
    v1::ClientMessage message;
    v1::SetView& view = *message.mutable_set_view();
    view.set_width(options_.size.width);
    view.set_height(options_.size.height);
    view.add_codecs(options_.codec);
    view.set_quality(options_.quality);
    connection_.send(std::move(message));
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

  /// Handles the next message, if one comes in time; whether it was a frame.
  bool takeMessage(Clock::time_point deadline) {
    const std::optional<v1::ServerMessage> message = connection_.receive(deadline);
    if (!message) return false;
    if (message->has_error()) throw RequestError(describe(message->error()));
    if (!message->has_frame()) return false;
    takeFrame(message->frame());
    return true;
  }

  void takeFrame(const v1::Frame& frame) {
    if (frame.codec() != options_.codec) {
      throw RequestError("the server sends " + v1::Codec_Name(frame.codec()) + ", not " +
                         v1::Codec_Name(options_.codec));
    }
    if (frame.width() != options_.size.width || frame.height() != options_.size.height) {
      throw RequestError("the server sends pictures of another size than asked for");
    }
    const Clock::time_point received = Clock::now();
    decoder_.decode(frame);
    const Clock::time_point decoded = Clock::now();
    delays_.decoded(frame.reflects_sequence(), decoded);

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
