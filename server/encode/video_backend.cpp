#include "video_backend.h"

extern "C" {
#include <libavutil/opt.h>
}

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "bit_budget.h"
#include "quality_scale.h"
#include "sluice/core/input_error.h"

namespace sluice::encode {

namespace {

void set(AVCodecContext& context, const char* option, const std::string& value) {
  if (const int error = av_opt_set(context.priv_data, option, value.c_str(), 0); error < 0) {
    throw core::EnvironmentError(std::string("the encoder ") + context.codec->name + " does not take " + option + "=" +
                                 value + ": " + media::libavError(error));
  }
}

void applyBudget(AVCodecContext& context, const BitBudget& budget) {
  context.rc_max_rate = budget.bitsPerSecond;
  context.rc_buffer_size = static_cast<int>(budget.bufferBits);
  context.rc_initial_buffer_occupancy = context.rc_buffer_size / 2;
}

double qualityOf(const EncoderSettings& settings) { return constantQuality(settings.codec, settings.quality); }

// ------------------------------------------------------------------------------------------------------------- x264

void configureX264(AVCodecContext& context, const EncoderSettings& settings) {
  set(context, "preset", "superfast");
  set(context, "tune", "zerolatency");
  set(context, "forced-idr", "1");
  context.refs = 1;
  const BitBudget budget = bitBudget(settings, settings.frameRate);
  if (settings.kilobitsPerSecond > 0) applyBudget(context, budget);
  if (settings.constantBitRate) {
    context.bit_rate = budget.bitsPerSecond;
  } else {
    set(context, "crf", std::to_string(qualityOf(settings)));
  }
}

/// x264 takes new bounds of a buffer that it has, and new rates of the kind that it follows.
bool retuneX264(AVCodecContext& context, const EncoderSettings& present, const EncoderSettings& wanted,
                double nominalRate) {
  if (wanted.constantBitRate != present.constantBitRate) return false;
  if ((wanted.kilobitsPerSecond > 0) != (present.kilobitsPerSecond > 0)) return false;
  const BitBudget budget = bitBudget(wanted, nominalRate);
  if (wanted.kilobitsPerSecond > 0) applyBudget(context, budget);
  if (wanted.constantBitRate) {
    context.bit_rate = budget.bitsPerSecond;
  } else {
    set(context, "crf", std::to_string(qualityOf(wanted)));
  }
  return true;
}

// ------------------------------------------------------------------------------------------------------------ NVENC

void configureNvenc(AVCodecContext& context, const EncoderSettings& settings) {
  set(context, "preset", "p3");
  set(context, "tune", "ull");
  set(context, "zerolatency", "1");
  set(context, "delay", "0");
  set(context, "forced-idr", "1");
  const std::string quality = std::to_string(std::lround(qualityOf(settings)));
  if (settings.kilobitsPerSecond == 0) {
    set(context, "rc", "constqp");
    set(context, "qp", quality);
    return;
  }
  const BitBudget budget = bitBudget(settings, settings.frameRate);
  applyBudget(context, budget);
  context.bit_rate = budget.bitsPerSecond;
  set(context, "rc", settings.constantBitRate ? "cbr" : "vbr");
  if (!settings.constantBitRate) set(context, "cq", quality);
}

// ---------------------------------------------------------------------------------------------------- VP9 and AV1

/// libvpx and libaom bound the rate of a stream without delay by their constant bit rate alone. With the quantiser kept
/// from falling below that of the quality, a simple picture does not use the rate up.
void setRate(AVCodecContext& context, const EncoderSettings& settings) {
  const int quantiser = static_cast<int>(std::lround(qualityOf(settings)));
  if (settings.kilobitsPerSecond == 0) {
    set(context, "crf", std::to_string(quantiser));
    context.bit_rate = 0;
    return;
  }
  const BitBudget budget = bitBudget(settings, settings.frameRate);
  applyBudget(context, budget);
  context.bit_rate = context.rc_min_rate = budget.bitsPerSecond;
  if (!settings.constantBitRate) context.qmin = quantiser;
  context.qmax = 63;
}

void configureVpx(AVCodecContext& context, const EncoderSettings& settings) {
  set(context, "deadline", "realtime");
  set(context, "cpu-used", "8");
  set(context, "row-mt", "1");
  set(context, "tile-columns", "2");
  set(context, "lag-in-frames", "0");
  set(context, "auto-alt-ref", "0");
  setRate(context, settings);
}

void configureAom(AVCodecContext& context, const EncoderSettings& settings) {
  set(context, "usage", "realtime");
  set(context, "cpu-used", "8");
  set(context, "aom-params", "cpu-used=10");
  set(context, "row-mt", "1");
  // Two tiles, of the least width that makes sense; libaom refuses to halve a small picture.
  if (context.width >= 512) set(context, "tile-columns", "1");
  set(context, "lag-in-frames", "0");
  setRate(context, settings);
}

constexpr auto kBackends = std::to_array<VideoBackend>({
    {core::Codec::Av1, "libaom-av1", false, configureAom, nullptr},
    {core::Codec::Vp9, "libvpx-vp9", false, configureVpx, nullptr},
    {core::Codec::H264, "h264_nvenc", true, configureNvenc, nullptr},
    {core::Codec::H264, "libx264", true, configureX264, retuneX264},
});

}  // namespace

std::span<const VideoBackend> videoBackends() { return kBackends; }

}  // namespace sluice::encode
