#include "sluice/client/frame_decoder.h"

#include <cstring>
#include <exception>
#include <string>

#include <png.h>
#include <turbojpeg.h>

#include "sluice/client/failure.h"
#include "sluice/media/video_decoder.h"

namespace sluice::client {

namespace {

constexpr std::size_t kBytesPerPixel = 4;

[[noreturn]] void fail(const v1::Frame& frame, const std::string& problem) {
  throw RequestError("frame " + std::to_string(frame.frame_id()) + " cannot be decoded: " + problem);
}

/// Compared before any memory is taken for the pixels.
void checkSize(const v1::Frame& frame, std::uint32_t width, std::uint32_t height) {
  if (width != frame.width() || height != frame.height()) {
    fail(frame, "it holds " + std::to_string(width) + "x" + std::to_string(height) + " pixels, its header says " +
                    std::to_string(frame.width()) + "x" + std::to_string(frame.height()));
  }
}

void resize(Picture& picture, std::uint32_t width, std::uint32_t height) {
  picture.width = static_cast<int>(width);
  picture.height = static_cast<int>(height);
  picture.rgba.resize(kBytesPerPixel * width * height);
}

/// One for each picture: after a damaged one, a handle may misread the next.
struct JpegHandle {
  tjhandle handle = tjInitDecompress();

  JpegHandle() {
    if (handle == nullptr) throw RequestError(std::string("no JPEG decoder: ") + tjGetErrorStr());
  }
  ~JpegHandle() { tjDestroy(handle); }
  JpegHandle(const JpegHandle&) = delete;
  JpegHandle& operator=(const JpegHandle&) = delete;
};

media::VideoCodec mediaCodec(v1::Codec codec) {
  switch (codec) {
    case v1::H264:
      return media::VideoCodec::H264;
    case v1::VP9:
      return media::VideoCodec::Vp9;
    default:
      return media::VideoCodec::Av1;
  }
}

}  // namespace

FrameDecoder::FrameDecoder() = default;
FrameDecoder::~FrameDecoder() = default;

const Picture& FrameDecoder::decode(const v1::Frame& frame) {
  switch (frame.codec()) {
    case v1::JPEG:
      decodeJpeg(frame);
      break;
    case v1::PNG:
      decodePng(frame);
      break;
    case v1::H264:
    case v1::VP9:
    case v1::AV1:
      decodeVideo(frame);
      break;
    default:
      fail(frame, "codec " + v1::Codec_Name(frame.codec()) + " is not known");
  }
  return picture_;
}

void FrameDecoder::decodeJpeg(const v1::Frame& frame) {
  const auto* bytes = reinterpret_cast<const unsigned char*>(frame.payload().data());
  const std::size_t size = frame.payload().size();
  const JpegHandle jpeg;
  int width = 0;
  int height = 0;
  int subsampling = 0;
  int colorspace = 0;
  if (tjDecompressHeader3(jpeg.handle, bytes, size, &width, &height, &subsampling, &colorspace) != 0) {
    fail(frame, tjGetErrorStr2(jpeg.handle));
  }
  checkSize(frame, static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height));
  resize(picture_, frame.width(), frame.height());
  auto* pixels = reinterpret_cast<unsigned char*>(picture_.rgba.data());
  if (tjDecompress2(jpeg.handle, bytes, size, pixels, width, /*pitch=*/0, height, TJPF_RGBA, 0) != 0) {
    fail(frame, tjGetErrorStr2(jpeg.handle));
  }
}

void FrameDecoder::decodeVideo(const v1::Frame& frame) {
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(frame.payload().data());
  try {
    // A keyframe may be of another stream than what came before: another size, other settings.
    if (frame.keyframe() || !video_ || videoCodec_ != frame.codec()) {
      video_ = std::make_unique<media::VideoDecoder>(mediaCodec(frame.codec()));
      videoCodec_ = frame.codec();
    }
    const media::RgbaPicture& shown = video_->decode({bytes, frame.payload().size()}, static_cast<int>(frame.width()),
                                                     static_cast<int>(frame.height()));
    resize(picture_, frame.width(), frame.height());
    std::memcpy(picture_.rgba.data(), shown.pixels.data(), shown.pixels.size());
  } catch (const Failure&) {
    throw;
  } catch (const std::exception& error) {
    // What follows builds on this frame.
    video_.reset();
    fail(frame, error.what());
  }
}

void FrameDecoder::decodePng(const v1::Frame& frame) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&image, frame.payload().data(), frame.payload().size()) == 0) {
    fail(frame, image.message);
  }
  image.format = PNG_FORMAT_RGBA;
  try {
    checkSize(frame, image.width, image.height);
    resize(picture_, frame.width(), frame.height());
  } catch (...) {
    png_image_free(&image);
    throw;
  }
  // Frees the image, whether or not it succeeds.
  if (png_image_finish_read(&image, nullptr, picture_.rgba.data(), /*row_stride=*/0, nullptr) == 0) {
    fail(frame, image.message);
  }
}

}  // namespace sluice::client
