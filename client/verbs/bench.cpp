#include <cctype>
#include <cmath>
#include <memory>
#include <ostream>

#include "sluice/client/failure.h"
#include "sluice/client/json.h"
#include "sluice/client/percentile.h"
#include "sluice/client/report.h"
#include "sluice/client/stream_benchmark.h"
#include "verbs/verb.h"

namespace sluice::client {

namespace {

constexpr double kBytesPerKilobyte = 1000;

struct BenchOptions {
  StreamBenchmarkOptions stream;
  std::string size = "1280x720";
  std::string codec = "jpeg";
  std::string mode = "automatic";
  bool still = false;
};

struct Quantiles {
  double median, p95, p99;

  explicit Quantiles(const std::vector<double>& samples)
      : median(percentile(samples, 0.5)), p95(percentile(samples, 0.95)), p99(percentile(samples, 0.99)) {}
};

Json quantilesJson(const std::vector<double>& samples) {
  const Quantiles quantiles(samples);
  return {{"median", quantiles.median}, {"p95", quantiles.p95}, {"p99", quantiles.p99}};
}

void printJson(std::ostream& out, const StreamBenchmarkResult& result, const Quantiles& delay, double framesPerSecond,
               double kilobytesPerSecond) {
  Json stages = Json::object();
  for (const StageSamples& stage : result.stages) stages[stage.name] = median(stage.milliseconds);
  out << toLine({{"input_to_decoded_ms", {{"median", delay.median}, {"p95", delay.p95}, {"p99", delay.p99}}},
                 {"response_ms", quantilesJson(result.responseMilliseconds)},
                 {"network_and_decode_ms", quantilesJson(result.networkAndDecodeMilliseconds)},
                 {"draw_ms", quantilesJson(result.drawMilliseconds)},
                 {"beside_drawing_ms", quantilesJson(result.besideDrawingMilliseconds)},
                 {"longest_delay_frames", result.longestDelayFrames},
                 {"psnr_db", median(result.psnrDecibels)},
                 {"inputs", result.inputToDecodedMilliseconds.size()},
                 {"frames_per_second", framesPerSecond},
                 {"kilobytes_per_second", kilobytesPerSecond},
                 {"frames", result.frames},
                 {"seconds", result.seconds},
                 {"decode_ms", median(result.decodeMilliseconds)},
                 {"stages", stages}});
}

void printText(std::ostream& out, const StreamBenchmarkResult& result, const Quantiles& delay, double framesPerSecond,
               double kilobytesPerSecond) {
  if (!result.inputToDecodedMilliseconds.empty()) {
    out << "input to decoded  " << formatRounded(delay.median) << " ms median, " << formatRounded(delay.p95)
        << " ms p95, " << formatRounded(delay.p99) << " ms p99, of " << result.inputToDecodedMilliseconds.size()
        << " cameras\n"
        << "  the server      " << formatRounded(median(result.responseMilliseconds)) << " ms median\n"
        << "  way, decoding   " << formatRounded(median(result.networkAndDecodeMilliseconds)) << " ms median\n"
        << "  beside drawing  " << formatRounded(median(result.besideDrawingMilliseconds)) << " ms median, drawing "
        << formatRounded(median(result.drawMilliseconds)) << " ms\n"
        << "  out of date     " << result.longestDelayFrames << " frames at most, with the first that shows a camera\n";
  }
  if (!result.psnrDecibels.empty()) {
    const double decibels = median(result.psnrDecibels);
    out << "quality           " << (std::isfinite(decibels) ? formatRounded(decibels) + " dB PSNR median" : "exact")
        << '\n';
  }
  out << "frames            " << formatRounded(framesPerSecond) << " per second\n"
      << "data              " << formatRounded(kilobytesPerSecond) << " kB per second\n";
  if (!result.decodeMilliseconds.empty()) {
    out << "decoding here     " << formatRounded(median(result.decodeMilliseconds)) << " ms median\n";
  }
  if (result.stages.empty()) return;
  out << "on the server     ms, median\n";
  for (const StageSamples& stage : result.stages) {
    out << "  " << stage.name << std::string(stage.name.size() < 24 ? 24 - stage.name.size() : 1, ' ')
        << formatRounded(median(stage.milliseconds), 3) << '\n';
  }
}

v1::Codec codecNamed(const std::string& name) {
  std::string upper = name;
  for (char& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  v1::Codec codec = v1::JPEG;
  v1::Codec_Parse(upper, &codec);
  return codec;
}

v1::QualityMode modeNamed(const std::string& name) {
  if (name == "fixed") return v1::FIXED_QUALITY;
  if (name == "bitrate") return v1::FIXED_BIT_RATE;
  return name == "lossless" ? v1::LOSSLESS : v1::AUTOMATIC;
}

void bench(const Context& context, const BenchOptions& options) {
  StreamBenchmarkOptions stream = options.stream;
  stream.size = parseSize(options.size);
  stream.codec = codecNamed(options.codec);
  stream.mode = modeNamed(options.mode);
  if (stream.mode == v1::FIXED_BIT_RATE && stream.kilobitsPerSecond == 0) {
    throw UsageError("--mode bitrate needs --kilobits");
  }
  stream.orbit = !options.still;

  Connection connection = context.connect();
  const StreamBenchmarkResult result = benchmarkStream(connection, stream);
  (context.json ? printJson : printText)(context.output.out, result, Quantiles(result.inputToDecodedMilliseconds),
                                         static_cast<double>(result.frames) / result.seconds,
                                         static_cast<double>(result.payloadBytes) / kBytesPerKilobyte / result.seconds);
}

}  // namespace

void addBench(CLI::App& app, Action& chosen) {
  auto options = std::make_shared<BenchOptions>();
  CLI::App* verb = app.add_subcommand("bench", "Measure the stream: delay from input to decoded picture, rate, bytes");
  verb->add_option("--seconds", options->stream.seconds, "How long")
      ->capture_default_str()
      ->check(CLI::Range(0.1, 86400.0));
  verb->add_option("--size", options->size, "Size of the picture in pixels")->capture_default_str()->type_name("WxH");
  verb->add_option("--codec", options->codec, "How pictures are encoded")
      ->capture_default_str()
      ->check(CLI::IsMember({"jpeg", "png", "h264", "vp9", "av1"}));
  verb->add_option("--mode", options->mode, "What gives way on a slow link")
      ->capture_default_str()
      ->check(CLI::IsMember({"automatic", "fixed", "bitrate", "lossless"}));
  verb->add_option("--kilobits", options->stream.kilobitsPerSecond, "A second, for --mode bitrate")
      ->check(CLI::PositiveNumber);
  verb->add_option("--quality", options->stream.quality, "Of jpeg; else the server's default")
      ->check(CLI::Range(1U, 100U));
  verb->add_option("--slow", options->stream.slowBytesPerSecond, "Take no more than so many bytes a second")
      ->check(CLI::PositiveNumber)
      ->type_name("BYTES_PER_SECOND");
  CLI::Option* inTurn =
      verb->add_flag("--in-turn", options->stream.inTurn,
                     "Send a camera only when the picture for the last one is there; else sixty a second");
  auto* still =
      verb->add_flag("--still", options->still, "Leave the camera at rest; no delay is measured")->excludes(inTurn);
  verb->add_flag_callback(
          "--orbit", [] {}, "Turn the camera about the scene, which is the default")
      ->excludes(still);
  verb->callback([&chosen, options] { chosen = [options](const Context& context) { bench(context, *options); }; });
}

}  // namespace sluice::client
