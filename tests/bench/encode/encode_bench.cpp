// Time and size of one encoded frame, 1280×720.
#include <benchmark/benchmark.h>

#include <cmath>

#include "sluice/encode/frame_encoder.h"

namespace {

using namespace sluice;

// Waves with fine ripples, about as busy as a picture of moving water.
core::Frame waves(core::ImageSize size) {
  core::Frame frame;
  frame.size = size;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const double swell = std::sin(0.011 * x + 3 * std::sin(0.007 * y));
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
  const core::Frame frame = waves({1280, 720});
  const auto encoder = encode::makeEncoder(settings);
  std::size_t bytes = 0;
  for (auto _ : state) {
    const core::EncodedFrame encoded = encoder->encode(frame);
    bytes = encoded.bytes.size();
    benchmark::DoNotOptimize(encoded.bytes.data());
  }
  state.counters["KB"] = static_cast<double>(bytes) / 1000;
}

BENCHMARK_CAPTURE(encodeFrame, jpeg_q80, {.codec = core::Codec::Jpeg, .quality = 80})->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(encodeFrame, jpeg_q95, {.codec = core::Codec::Jpeg, .quality = 95})->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(encodeFrame, png, {.codec = core::Codec::Png})->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
