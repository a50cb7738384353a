#include "sluice/media/mp4_writer.h"

#include <cmath>
#include <cstring>
#include <string>
#include <utility>

#include "annex_b.h"
#include "sluice/core/check.h"
#include "sluice/core/input_error.h"
#include "sluice/media/libav.h"

namespace sluice::media {

namespace {

/// Holds 30000/1001 and the like exactly.
constexpr int kMaxDenominator = 1001;

AVRational frameRate(double framesPerSecond) {
  if (framesPerSecond < 1) return av_inv_q(frameRate(1 / framesPerSecond));
  for (int denominator = 1; denominator <= kMaxDenominator; ++denominator) {
    const double numerator = framesPerSecond * denominator;
    if (std::abs(numerator - std::round(numerator)) < 1e-9 * numerator) {
      return {static_cast<int>(std::round(numerator)), denominator};
    }
  }
  return {static_cast<int>(std::round(framesPerSecond * kMaxDenominator)), kMaxDenominator};
}

int roundedUpToEven(int size) { return size + size % 2; }

}  // namespace

class Mp4Writer::Impl {
 public:
  Impl(std::filesystem::path path, const Mp4Settings& settings)
      : path_(std::move(path)), part_(path_.string() + ".part"), settings_(settings) {
    SLUICE_CHECK(settings.width > 0 && settings.height > 0 && settings.framesPerSecond > 0);
    quietLibav();
    std::error_code ignored;
    if (std::filesystem::is_directory(path_, ignored)) fail("is a folder");
    AVFormatContext* context = nullptr;
    check(avformat_alloc_output_context2(&context, nullptr, "mp4", part_.c_str()));
    output_.reset(context);
    check(avio_open(&context->pb, part_.c_str(), AVIO_FLAG_WRITE));
  }

  ~Impl() {
    output_.reset();
    std::error_code ignored;  // Once finished there is nothing to remove.
    std::filesystem::remove(part_, ignored);
  }

  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  std::uint64_t frames() const { return frames_; }

  void write(std::span<const std::uint8_t> bytes, bool keyframe) {
    SLUICE_CHECK(output_ != nullptr);
    if (frames_ == 0) begin(bytes, keyframe);
    const AVStream& stream = *output_->streams[0];
    const AVRational frameDuration = av_inv_q(stream.avg_frame_rate);
    const auto number = static_cast<std::int64_t>(frames_);
    const auto timeOf = [&](std::int64_t frame) { return av_rescale_q(frame, frameDuration, stream.time_base); };

    av_packet_unref(packet_.get());
    check(av_new_packet(packet_.get(), static_cast<int>(bytes.size())));
    std::memcpy(packet_->data, bytes.data(), bytes.size());
    packet_->pts = packet_->dts = timeOf(number);
    packet_->duration = timeOf(number + 1) - timeOf(number);
    packet_->flags = keyframe ? AV_PKT_FLAG_KEY : 0;
    check(av_write_frame(output_.get(), packet_.get()));
    ++frames_;
  }

  void finish() {
    SLUICE_CHECK(output_ != nullptr);
    if (frames_ == 0) fail("holds no frame");
    check(av_write_trailer(output_.get()));
    check(avio_closep(&output_->pb));
    output_.reset();
    std::error_code error;
    std::filesystem::rename(part_, path_, error);
    if (error) fail("cannot be written: " + error.message());
  }

 private:
  void begin(std::span<const std::uint8_t> bytes, bool keyframe) {
    const std::vector<std::uint8_t> sets = parameterSets(bytes);
    if (!keyframe || sets.empty()) fail("cannot begin with a frame that is no keyframe of H.264");

    AVStream* stream = avformat_new_stream(output_.get(), nullptr);
    if (stream == nullptr) fail("out of memory");
    stream->avg_frame_rate = frameRate(settings_.framesPerSecond);
    stream->time_base = av_inv_q(stream->avg_frame_rate);
    AVCodecParameters& codec = *stream->codecpar;
    codec.codec_type = AVMEDIA_TYPE_VIDEO;
    codec.codec_id = AV_CODEC_ID_H264;
    codec.width = roundedUpToEven(settings_.width);
    codec.height = roundedUpToEven(settings_.height);
    codec.format = AV_PIX_FMT_YUV420P;
    codec.color_range = AVCOL_RANGE_MPEG;
    codec.color_primaries = AVCOL_PRI_BT709;
    codec.color_trc = AVCOL_TRC_BT709;
    codec.color_space = AVCOL_SPC_BT709;
    codec.extradata = static_cast<std::uint8_t*>(av_mallocz(sets.size() + AV_INPUT_BUFFER_PADDING_SIZE));
    if (codec.extradata == nullptr) fail("out of memory");
    std::memcpy(codec.extradata, sets.data(), sets.size());
    codec.extradata_size = static_cast<int>(sets.size());

    AVDictionary* options = nullptr;
    av_dict_set(&options, "movflags", "+faststart+write_colr", 0);
    const int error = avformat_write_header(output_.get(), &options);
    av_dict_free(&options);
    check(error);
  }

  [[noreturn]] void fail(const std::string& problem) const { throw core::InputError(path_.string(), "", problem); }

  void check(int result) const {
    if (result < 0) fail("cannot be written: " + libavError(result));
  }

  const std::filesystem::path path_;
  const std::filesystem::path part_;
  const Mp4Settings settings_;
  OutputContext output_;
  PacketPtr packet_ = makePacket();
  std::uint64_t frames_ = 0;
};

Mp4Writer::Mp4Writer(std::filesystem::path path, const Mp4Settings& settings)
    : impl_(std::make_unique<Impl>(std::move(path), settings)) {}
Mp4Writer::~Mp4Writer() = default;

void Mp4Writer::write(std::span<const std::uint8_t> packet, bool keyframe) { impl_->write(packet, keyframe); }
std::uint64_t Mp4Writer::frames() const { return impl_->frames(); }
void Mp4Writer::finish() { impl_->finish(); }

}  // namespace sluice::media
