// Fidelity and bytes of every lossy codec over `quality`, on running water while the camera turns, 1280×720 at 25
// frames a second: what server/encode/quality_scale.cpp is set from. The keyframe, which comes first, is not counted.
// Counters: PSNR of luma (BT.709, of what the decoder gives against the picture), dB, mean over frames; KB a frame.
#include <benchmark/benchmark.h>
#include <turbojpeg.h>

#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "sluice/encode/frame_encoder.h"
#include "sluice/media/video_decoder.h"
#include "turning_view.h"

namespace sluice {
namespace {

constexpr int kFrames = 20;

const std::vector<core::Frame>& pictures() {
  static const std::vector<core::Frame> frames = bench::turningView(kFrames);
  return frames;
}

/// Gives the RGBA of one stream's packets in turn.
class Decoder {
 public:
  explicit Decoder(core::Codec codec) {
    if (codec == core::Codec::H264) video_.emplace(media::VideoCodec::H264);
    if (codec == core::Codec::Vp9) video_.emplace(media::VideoCodec::Vp9);
    if (codec == core::Codec::Av1) video_.emplace(media::VideoCodec::Av1);
  }

  std::vector<std::uint8_t> decode(const core::EncodedFrame& encoded) {
    const auto [width, height] = encoded.size;
    if (video_) return video_->decode(encoded.bytes, width, height).pixels;
    std::vector<std::uint8_t> rgba(4U * width * height);
    const std::unique_ptr<void, decltype(&tjDestroy)> jpeg(tjInitDecompress(), tjDestroy);
    tjDecompress2(jpeg.get(), encoded.bytes.data(), encoded.bytes.size(), rgba.data(), width, 0, height, TJPF_RGBA, 0);
    return rgba;
  }

 private:
  std::optional<media::VideoDecoder> video_;
};

double psnrOfLuma(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b) {
  double squares = 0;
  for (std::size_t i = 0; i < a.size(); i += 4) {
    const double difference = 0.2126 * (a[i] - b[i]) + 0.7152 * (a[i + 1] - b[i + 1]) + 0.0722 * (a[i + 2] - b[i + 2]);
    squares += difference * difference;
  }
  return 10 * std::log10(255.0 * 255.0 * static_cast<double>(a.size() / 4) / squares);
}

/// An iteration is a frame; its time that of the encoder alone.
void encodeAt(benchmark::State& state, core::Codec codec) {
  const std::vector<core::Frame>& frames = pictures();
  const auto encoder = encode::makeEncoder({.codec = codec, .quality = static_cast<int>(state.range(0))});
  Decoder decoder(codec);
  decoder.decode(encoder->encode(frames.front()));
  double psnr = 0;
  std::size_t bytes = 0;
  std::size_t number = 1;
  for (auto _ : state) {
    const core::EncodedFrame encoded = encoder->encode(frames[number]);
    state.PauseTiming();
    psnr += psnrOfLuma(decoder.decode(encoded), frames[number].pixels);
    bytes += encoded.bytes.size();
    ++number;
    state.ResumeTiming();
  }
  state.counters["PSNR"] = psnr / static_cast<double>(number - 1);
  state.counters["KB"] = static_cast<double>(bytes) / 1000 / static_cast<double>(number - 1);
}

const char* nameOf(core::Codec codec) {
  switch (codec) {
    case core::Codec::Jpeg:
      return "jpeg";
    case core::Codec::H264:
      return "h264";
    case core::Codec::Vp9:
      return "vp9";
    default:
      return "av1";
  }
}

}  // namespace
}  // namespace sluice

int main(int count, char** arguments) {
  using namespace sluice;
  benchmark::Initialize(&count, arguments);
  if (benchmark::ReportUnrecognizedArguments(count, arguments)) return 2;
  for (const core::Codec codec : encode::availableCodecs()) {
    if (codec == core::Codec::Png) continue;
    benchmark::RegisterBenchmark(nameOf(codec), encodeAt, codec)
        ->ArgName("quality")
        ->ArgsProduct({{1, 20, 40, 60, 80, 90, 100}})
        ->Iterations(kFrames - 1)
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
  }
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
