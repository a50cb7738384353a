// Time and size of one encoded frame, 1280×720.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sluice/encode/frame_encoder.h"

namespace {

using namespace sluice;

// Waves with fine ripples, about as busy as a picture of moving water.
core::Frame waves(core::ImageSize size, double phase) {
  core::Frame frame;
  frame.size = size;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const double swell = std::sin(0.011 * x + phase + 3 * std::sin(0.007 * y));
      const double ripple = std::sin(0.4 * x + 5 * swell) * std::sin(0.33 * y + 4 * swell);
      for (const double base : {40.0, 105.0, 130.0}) {
        frame.pixels.push_back(static_cast<std::uint8_t>(base + 40 * swell + 18 * ripple + 1.5));
      }
      frame.pixels.push_back(255);
    }
  }
  return frame;
}

void encodeFrame(benchmark::State& state, encode::EncoderSettings settings) {
  const std::vector<core::Codec> available = encode::availableCodecs();
  if (std::find(available.begin(), available.end(), settings.codec) == available.end()) {
    state.SkipWithError("this build has no such codec");
    return;
  }
  // Two phases in turn, so that video has something to code in every frame.
  const core::Frame frames[] = {waves({1280, 720}, 0), waves({1280, 720}, 0.1)};
  const auto encoder = encode::makeEncoder(settings);
  std::size_t bytes = 0;
  std::size_t number = 0;
  for (auto _ : state) {
    const core::EncodedFrame encoded = encoder->encode(frames[number++ % 2]);
    bytes = encoded.bytes.size();
    benchmark::DoNotOptimize(encoded.bytes.data());
  }
  state.counters["KB"] = static_cast<double>(bytes) / 1000;
}

BENCHMARK_CAPTURE(encodeFrame, jpeg_q80, {.codec = core::Codec::Jpeg, .quality = 80})->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(encodeFrame, jpeg_q95, {.codec = core::Codec::Jpeg, .quality = 95})->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(encodeFrame, h264_q80, {.codec = core::Codec::H264, .quality = 80})->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(encodeFrame, vp9_q80, {.codec = core::Codec::Vp9, .quality = 80})->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(encodeFrame, av1_q80, {.codec = core::Codec::Av1, .quality = 80})->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(encodeFrame, png, {.codec = core::Codec::Png})->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
