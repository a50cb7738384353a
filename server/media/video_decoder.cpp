#include "sluice/media/video_decoder.h"

extern "C" {
#include <libavutil/opt.h>
}

#include <algorithm>
#include <cstring>
#include <string>

#include "sluice/core/input_error.h"
#include "sluice/core/simd.h"
#include "sluice/media/libav.h"

namespace sluice::media {

namespace {

const AVCodec* findDecoder(VideoCodec codec) {
  switch (codec) {
    case VideoCodec::H264:
      return avcodec_find_decoder(AV_CODEC_ID_H264);
    case VideoCodec::Vp9:
      return avcodec_find_decoder(AV_CODEC_ID_VP9);
    case VideoCodec::Av1:
      // FFmpeg's own "av1" decodes by hardware alone.
      if (const AVCodec* dav1d = avcodec_find_decoder_by_name("libdav1d")) return dav1d;
      return avcodec_find_decoder_by_name("libaom-av1");
  }
  return nullptr;
}

[[noreturn]] void fail(const std::string& problem) {
  throw core::InputError("", "", "the video cannot be decoded: " + problem);
}

// The inverse of BT.709-6, items 3.2 and 3.3, from the limited range of item 4.6, in units of 1/8192. libyuv's own is
// cut off at a gain of 2 where blue needs 2.112, twelve levels at saturated colours.
constexpr int kBits = 13;
constexpr int kY = 9539;    // 255/219
constexpr int kVr = 14686;  // 1.5748 · 255/224
constexpr int kUg = -1747;  // −1.8556 · 0.0722/0.7152 · 255/224
constexpr int kVg = -4366;  // −1.5748 · 0.2126/0.7152 · 255/224
constexpr int kUb = 17305;  // 1.8556 · 255/224

std::uint8_t level(int value) { return static_cast<std::uint8_t>(std::clamp(value >> kBits, 0, 255)); }

SLUICE_SIMD_CLONES void toRgbaRow(const std::uint8_t* __restrict luma, const std::uint8_t* __restrict u,
                                  const std::uint8_t* __restrict v, int width, std::uint8_t* __restrict rgba) {
  for (int x = 0; x < width; ++x) {
    const int y = kY * (luma[x] - 16) + (1 << (kBits - 1));
    const int cb = u[x / 2] - 128;
    const int cr = v[x / 2] - 128;
    rgba[4 * x] = level(y + kVr * cr);
    rgba[4 * x + 1] = level(y + kUg * cb + kVg * cr);
    rgba[4 * x + 2] = level(y + kUb * cb);
    rgba[4 * x + 3] = 255;
  }
}

}  // namespace

class VideoDecoder::Impl {
 public:
  explicit Impl(VideoCodec codec) {
    quietLibav();
    const AVCodec* decoder = findDecoder(codec);
    if (decoder == nullptr) throw core::EnvironmentError("FFmpeg has no decoder for this video");
    context_ = makeCodecContext(decoder);
    context_->flags |= AV_CODEC_FLAG_LOW_DELAY;
    // Threads that share a picture; threads with a picture each would hold pictures back.
    context_->thread_type = FF_THREAD_SLICE;
    context_->thread_count = 2;
    context_->err_recognition = AV_EF_CAREFUL | AV_EF_EXPLODE;
    if (std::strcmp(decoder->name, "libdav1d") == 0) av_opt_set_int(context_->priv_data, "framedelay", 1, 0);
    if (const int error = avcodec_open2(context_.get(), decoder, nullptr); error < 0) {
      throw core::EnvironmentError("the decoder " + std::string(decoder->name) +
                                   " does not start: " + libavError(error));
    }
  }

  const RgbaPicture& decode(std::span<const std::uint8_t> bytes, int width, int height) {
    // FFmpeg reads beyond the end of a packet.
    padded_.assign(bytes.begin(), bytes.end());
    padded_.resize(bytes.size() + AV_INPUT_BUFFER_PADDING_SIZE);
    packet_->data = padded_.data();
    packet_->size = static_cast<int>(bytes.size());
    if (const int error = avcodec_send_packet(context_.get(), packet_.get()); error < 0) fail(libavError(error));
    const int error = avcodec_receive_frame(context_.get(), frame_.get());
    if (error == AVERROR(EAGAIN)) fail("it shows no picture; a stream begins with a keyframe");
    if (error < 0) fail(libavError(error));
    if ((frame_->flags & AV_FRAME_FLAG_CORRUPT) != 0 || frame_->decode_error_flags != 0) fail("damaged");
    convert(width, height);
    return picture_;
  }

 private:
  void convert(int width, int height) {
    const AVFrame& frame = *frame_;
    const auto fits = [](int coded, int shown) { return coded == shown || (coded == shown + 1 && shown % 2 == 1); };
    if (!fits(frame.width, width) || !fits(frame.height, height)) {
      fail("it holds " + std::to_string(frame.width) + "x" + std::to_string(frame.height) + " pixels, not " +
           std::to_string(width) + "x" + std::to_string(height));
    }
    if (frame.format != AV_PIX_FMT_YUV420P) fail("its pixels are not 8-bit 4:2:0");
    picture_.width = width;
    picture_.height = height;
    picture_.pixels.resize(4U * static_cast<std::size_t>(width) * height);
    for (int y = 0; y < height; ++y) {
      const auto row = static_cast<std::ptrdiff_t>(y);
      toRgbaRow(frame.data[0] + row * frame.linesize[0], frame.data[1] + row / 2 * frame.linesize[1],
                frame.data[2] + row / 2 * frame.linesize[2], width, picture_.pixels.data() + 4 * row * width);
    }
  }

  CodecContext context_;
  FramePtr frame_ = makeFrame();
  PacketPtr packet_ = makePacket();
  std::vector<std::uint8_t> padded_;
  RgbaPicture picture_;
};

bool hasVideo() { return true; }

VideoDecoder::VideoDecoder(VideoCodec codec) : impl_(std::make_unique<Impl>(codec)) {}
VideoDecoder::~VideoDecoder() = default;
VideoDecoder::VideoDecoder(VideoDecoder&&) noexcept = default;
VideoDecoder& VideoDecoder::operator=(VideoDecoder&&) noexcept = default;

const RgbaPicture& VideoDecoder::decode(std::span<const std::uint8_t> packet, int width, int height) {
  return impl_->decode(packet, width, height);
}

}  // namespace sluice::media
