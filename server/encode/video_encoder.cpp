#include "video_encoder.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "decoder_name.h"
#include "encoded_frame.h"
#include "i420_picture.h"
#include "sluice/core/check.h"
#include "sluice/core/input_error.h"
#include "video_backend.h"

namespace sluice::encode {

namespace {

using Bytes = std::vector<std::uint8_t>;

/// Slices or tiles of a picture share so many threads; each slice more costs bytes.
constexpr int kThreads = 2;

core::ImageSize codedSizeOf(const VideoBackend& backend, core::ImageSize size) {
  if (!backend.evenSizes) return size;
  return {size.width + size.width % 2, size.height + size.height % 2};
}

/// A stream of pictures of one size. Throws core::EnvironmentError where the encoder does not start.
class VideoStream {
 public:
  VideoStream(const VideoBackend& backend, const EncoderSettings& settings, core::ImageSize size)
      : backend_(backend), size_(size), codedSize_(codedSizeOf(backend, size)), nominalRate_(settings.frameRate) {
    media::quietLibav();
    const AVCodec* codec = avcodec_find_encoder_by_name(backend.encoder);
    if (codec == nullptr) throw core::EnvironmentError(std::string("FFmpeg has no encoder ") + backend.encoder);
    context_ = media::makeCodecContext(codec);
    describeStream(settings);
    backend.configure(*context_, settings);
    if (const int error = avcodec_open2(context_.get(), codec, nullptr); error < 0) fail("does not start", error);
    frame_->format = context_->pix_fmt;
    frame_->width = codedSize_.width;
    frame_->height = codedSize_.height;
    if (const int error = av_frame_get_buffer(frame_.get(), 0); error < 0) fail("does not start", error);
  }

  core::ImageSize size() const { return size_; }

  bool retune(const EncoderSettings& present, const EncoderSettings& wanted) {
    return backend_.retune != nullptr && backend_.retune(*context_, present, wanted, nominalRate_);
  }

  struct Packet {
    Bytes bytes;
    bool keyframe = false;
  };

  Packet encode(const std::uint8_t* rgba, bool keyframe) {
    // The encoder may still hold the last picture's memory as its reference.
    if (const int error = av_frame_make_writable(frame_.get()); error < 0) fail("has no memory", error);
    toI420(rgba, size_, codedSize_,
           {frame_->data[0], frame_->data[1], frame_->data[2], frame_->linesize[0], frame_->linesize[1],
            frame_->linesize[2]});
    frame_->pict_type = keyframe ? AV_PICTURE_TYPE_I : AV_PICTURE_TYPE_NONE;
    frame_->pts = number_++;
    if (const int error = avcodec_send_frame(context_.get(), frame_.get()); error < 0) fail("takes no frame", error);
    av_packet_unref(packet_.get());
    if (const int error = avcodec_receive_packet(context_.get(), packet_.get()); error < 0) {
      fail("gives no packet for its frame", error);
    }
    return {Bytes(packet_->data, packet_->data + packet_->size), (packet_->flags & AV_PKT_FLAG_KEY) != 0};
  }

 private:
  void describeStream(const EncoderSettings& settings) {
    AVCodecContext& context = *context_;
    context.width = codedSize_.width;
    context.height = codedSize_.height;
    context.pix_fmt = AV_PIX_FMT_YUV420P;
    constexpr int kMaxRateTerm = 100000;
    context.framerate = av_d2q(settings.frameRate, kMaxRateTerm);
    context.time_base = av_inv_q(context.framerate);
    context.max_b_frames = 0;
    constexpr int kNoKeyframesByThemselves = 1 << 30;
    context.gop_size = kNoKeyframesByThemselves;
    context.thread_count = kThreads;
    context.thread_type = FF_THREAD_SLICE;
    context.color_range = AVCOL_RANGE_MPEG;
    context.color_primaries = AVCOL_PRI_BT709;
    context.color_trc = AVCOL_TRC_BT709;
    context.colorspace = AVCOL_SPC_BT709;
    context.chroma_sample_location = AVCHROMA_LOC_CENTER;
  }

  [[noreturn]] void fail(const std::string& problem, int error) const {
    throw core::EnvironmentError(std::string("the encoder ") + backend_.encoder + " " + problem + ": " +
                                 media::libavError(error));
  }

  const VideoBackend& backend_;
  const core::ImageSize size_;
  const core::ImageSize codedSize_;
  const double nominalRate_;
  media::CodecContext context_;
  media::FramePtr frame_ = media::makeFrame();
  media::PacketPtr packet_ = media::makePacket();
  std::int64_t number_ = 0;
};

class VideoEncoder final : public FrameEncoder {
 public:
  explicit VideoEncoder(const EncoderSettings& settings) : settings_(settings) {
    SLUICE_CHECK(settings.quality >= 1 && settings.quality <= 100);
    SLUICE_CHECK(settings.frameRate > 0 && settings.kilobitsPerSecond >= 0);
    SLUICE_CHECK(!settings.constantBitRate || settings.kilobitsPerSecond > 0);
  }

  core::EncodedFrame encode(const core::Frame& frame) override {
    bool keyframe = false;
    core::EncodedFrame encoded = encodeTimed(frame, settings_.codec, [&] {
      VideoStream::Packet packet = encodePixels(frame);
      keyframe = packet.keyframe;
      return std::move(packet.bytes);
    });
    keyframeWanted_ = false;
    encoded.keyframe = keyframe;
    encoded.quality = settings_.quality;
    if (keyframe) encoded.decoder = decoderName(settings_.codec, encoded.bytes, frame.size);
    return encoded;
  }

  void requestKeyframe() override { keyframeWanted_ = true; }

  bool retune(const EncoderSettings& settings) override {
    if (settings == settings_) return true;
    if (settings.codec != settings_.codec) return false;
    if (stream_ && !stream_->retune(settings_, settings)) return false;
    settings_ = settings;
    return true;
  }

 private:
  VideoStream::Packet encodePixels(const core::Frame& frame) {
    if (stream_ && stream_->size() == frame.size) return stream_->encode(frame.pixels.data(), keyframeWanted_);
    stream_.reset();
    // An encoder that opens may still fail at, or hold back, its first frame.
    std::string problems;
    for (const VideoBackend& backend : videoBackends()) {
      if (backend.codec != settings_.codec) continue;
      try {
        auto stream = std::make_unique<VideoStream>(backend, settings_, frame.size);
        VideoStream::Packet packet = stream->encode(frame.pixels.data(), true);
        stream_ = std::move(stream);
        return packet;
      } catch (const core::EnvironmentError& error) {
        problems += (problems.empty() ? "" : "; ") + std::string(error.what());
      }
    }
    throw core::EnvironmentError(problems);
  }

  EncoderSettings settings_;
  std::unique_ptr<VideoStream> stream_;
  bool keyframeWanted_ = false;
};

bool encodes(core::Codec codec) {
  core::Frame probe;
  probe.size = {320, 192};
  probe.pixels.resize(4U * 320 * 192);
  try {
    makeVideoEncoder({.codec = codec})->encode(probe);
    return true;
  } catch (const core::EnvironmentError&) {
    return false;
  }
}

}  // namespace

std::vector<core::Codec> availableVideoCodecs() {
  std::vector<core::Codec> codecs;
  for (const core::Codec codec : {core::Codec::Av1, core::Codec::Vp9, core::Codec::H264}) {
    if (encodes(codec)) codecs.push_back(codec);
  }
  return codecs;
}

std::unique_ptr<FrameEncoder> makeVideoEncoder(const EncoderSettings& settings) {
  return std::make_unique<VideoEncoder>(settings);
}

}  // namespace sluice::encode
