#include "movie.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "sluice/core/input_error.h"
#include "sluice/encode/frame_encoder.h"
#include "sluice/media/mp4_writer.h"

namespace sluice::app {

namespace {

class PictureFolder final : public Movie {
 public:
  explicit PictureFolder(std::filesystem::path folder) : folder_(std::move(folder)) {
    std::error_code error;
    std::filesystem::create_directories(folder_, error);
    if (error) throw core::InputError(folder_.string(), "--out", "cannot be made: " + error.message());
  }

  void write(int number, const core::Frame& frame) override {
    char name[32];
    std::snprintf(name, sizeof name, "frame_%04d.png", number);
    encode::writePng(frame, (folder_ / name).string());
  }

 private:
  std::filesystem::path folder_;
};

class Mp4Movie final : public Movie {
 public:
  Mp4Movie(const std::string& path, core::ImageSize size, double framesPerSecond, int quality)
      : framesBetweenKeyframes_(
            std::max<std::uint64_t>(1, static_cast<std::uint64_t>(std::lround(2 * framesPerSecond)))),
        encoder_(encode::makeEncoder(settingsFor(quality, framesPerSecond))),
        file_(path, {.width = size.width, .height = size.height, .framesPerSecond = framesPerSecond}) {}

  void write(int /*number*/, const core::Frame& frame) override {
    // Every two seconds, for players that jump about.
    if (file_.frames() % framesBetweenKeyframes_ == 0) encoder_->requestKeyframe();
    const core::EncodedFrame encoded = encoder_->encode(frame);
    file_.write(encoded.bytes, encoded.keyframe);
  }

  void finish() override { file_.finish(); }

 private:
  static encode::EncoderSettings settingsFor(int quality, double framesPerSecond) {
    encode::EncoderSettings settings;
    settings.codec = core::Codec::H264;
    settings.quality = quality;
    settings.frameRate = framesPerSecond;
    return settings;
  }

  std::uint64_t framesBetweenKeyframes_;
  std::unique_ptr<encode::FrameEncoder> encoder_;
  media::Mp4Writer file_;
};

}  // namespace

std::unique_ptr<Movie> openMovie(const std::string& path, core::ImageSize size, double framesPerSecond, int quality) {
  if (path.ends_with(".mp4")) return std::make_unique<Mp4Movie>(path, size, framesPerSecond, quality);
  return std::make_unique<PictureFolder>(path);
}

}  // namespace sluice::app
