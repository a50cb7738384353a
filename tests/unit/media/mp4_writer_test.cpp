#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "sluice/core/input_error.h"
#include "sluice/encode/frame_encoder.h"
#include "sluice/media/libav.h"
#include "sluice/media/mp4_writer.h"
#include "sluice/media/video_decoder.h"

namespace sluice::media {
namespace {

namespace fs = std::filesystem;

core::Frame picture(core::ImageSize size, int shade) {
  core::Frame frame;
  frame.size = size;
  frame.pixels.assign(4U * size.width * size.height, static_cast<std::uint8_t>(shade));
  return frame;
}

void writeMovie(const fs::path& path, core::ImageSize size, double framesPerSecond, int frames) {
  const auto encoder = encode::makeEncoder({.codec = core::Codec::H264, .quality = 90});
  Mp4Writer writer(path, {size.width, size.height, framesPerSecond});
  for (int k = 0; k < frames; ++k) {
    const core::EncodedFrame encoded = encoder->encode(picture(size, 40 + 10 * k));
    writer.write(encoded.bytes, encoded.keyframe);
  }
  EXPECT_FALSE(fs::exists(path)) << "before it is complete";
  writer.finish();
}

struct CloseInput {
  void operator()(AVFormatContext* context) const { avformat_close_input(&context); }
};
using InputContext = std::unique_ptr<AVFormatContext, CloseInput>;

InputContext openMovie(const fs::path& path) {
  AVFormatContext* context = nullptr;
  EXPECT_EQ(avformat_open_input(&context, path.c_str(), nullptr, nullptr), 0);
  EXPECT_GE(avformat_find_stream_info(context, nullptr), 0);
  return InputContext(context);
}

class Mp4 : public testing::Test {
 protected:
  Mp4() { fs::create_directories(folder_); }
  ~Mp4() override { fs::remove_all(folder_); }
  const fs::path folder_ =
      fs::path(testing::TempDir()) / ("sluice_mp4_" + std::to_string(testing::UnitTest::GetInstance()->random_seed()) +
                                      testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(Mp4, HoldsEveryFrameAtItsTime) {
  for (const auto& [rate, numerator, denominator] :
       {std::tuple{25.0, 25, 1}, std::tuple{60.0, 60, 1}, std::tuple{30000.0 / 1001, 30000, 1001},
        std::tuple{0.5, 1, 2}, std::tuple{12.5, 25, 2}}) {
    const fs::path file = folder_ / "movie.mp4";
    constexpr int kFrames = 7;
    fs::remove(file);
    writeMovie(file, {64, 48}, rate, kFrames);
    const InputContext input = openMovie(file);
    const AVStream& stream = *input->streams[0];
    EXPECT_EQ(av_cmp_q(stream.avg_frame_rate, {numerator, denominator}), 0) << rate;
    EXPECT_EQ(stream.codecpar->codec_id, AV_CODEC_ID_H264);
    EXPECT_EQ(stream.codecpar->color_space, AVCOL_SPC_BT709);
    EXPECT_EQ(stream.codecpar->color_range, AVCOL_RANGE_MPEG);
    const PacketPtr packet = makePacket();
    int frames = 0;
    for (; av_read_frame(input.get(), packet.get()) == 0; ++frames) {
      EXPECT_EQ(packet->pts, av_rescale_q(frames, {denominator, numerator}, stream.time_base));
      av_packet_unref(packet.get());
    }
    EXPECT_EQ(frames, kFrames);
    EXPECT_FALSE(fs::exists(file.string() + ".part"));
  }
}

TEST_F(Mp4, LeavesNothingWhereItWasNotFinished) {
  const fs::path file = folder_ / "movie.mp4";
  {
    Mp4Writer writer(file, {64, 48, 25});
    EXPECT_TRUE(fs::exists(file.string() + ".part"));
    EXPECT_THROW(writer.finish(), core::InputError) << "it holds no frame";
  }
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(Mp4, NamesThePathThatCannotBeWritten) {
  for (const fs::path& path : {folder_, folder_ / "no" / "such" / "movie.mp4"}) {
    try {
      const Mp4Writer writer(path, {64, 48, 25});
      FAIL() << "was made";
    } catch (const core::InputError& error) {
      EXPECT_EQ(error.where(), path.string());
    }
  }
}

TEST_F(Mp4, RefusesAStartWithoutKeyframe) {
  const auto encoder = encode::makeEncoder({.codec = core::Codec::H264});
  encoder->encode(picture({64, 48}, 10));
  const core::EncodedFrame delta = encoder->encode(picture({64, 48}, 20));
  Mp4Writer writer(folder_ / "movie.mp4", {64, 48, 25});
  EXPECT_THROW(writer.write(delta.bytes, delta.keyframe), core::InputError);
}

TEST(VideoDecoder, RefusesWhatItCannotShow) {
  for (const auto& [codec, mediaCodec] :
       {std::pair{core::Codec::H264, VideoCodec::H264}, std::pair{core::Codec::Vp9, VideoCodec::Vp9},
        std::pair{core::Codec::Av1, VideoCodec::Av1}}) {
    const auto encoder = encode::makeEncoder({.codec = codec});
    const core::EncodedFrame key = encoder->encode(picture({64, 48}, 10));
    const core::EncodedFrame delta = encoder->encode(picture({64, 48}, 20));
    VideoDecoder fresh(mediaCodec);
    EXPECT_THROW(fresh.decode(delta.bytes, 64, 48), core::InputError) << "no keyframe";
    VideoDecoder other(mediaCodec);
    EXPECT_THROW(other.decode(key.bytes, 32, 48), core::InputError) << "another size";
    VideoDecoder third(mediaCodec);
    const std::vector<std::uint8_t> noise(100, 0x5A);
    EXPECT_THROW(third.decode(noise, 64, 48), core::InputError) << "noise";
  }
}

}  // namespace
}  // namespace sluice::media
