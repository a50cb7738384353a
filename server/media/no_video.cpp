// The module in a build without SLUICE_VIDEO.
#include "sluice/core/input_error.h"
#include "sluice/media/mp4_writer.h"
#include "sluice/media/video_decoder.h"

namespace sluice::media {

namespace {

[[noreturn]] void fail() { throw core::EnvironmentError("this program was built without video (SLUICE_VIDEO)"); }

}  // namespace

bool hasVideo() { return false; }

class VideoDecoder::Impl {};
VideoDecoder::VideoDecoder(VideoCodec) { fail(); }
VideoDecoder::~VideoDecoder() = default;
VideoDecoder::VideoDecoder(VideoDecoder&&) noexcept = default;
VideoDecoder& VideoDecoder::operator=(VideoDecoder&&) noexcept = default;
const RgbaPicture& VideoDecoder::decode(std::span<const std::uint8_t>, int, int) { fail(); }

class Mp4Writer::Impl {};
Mp4Writer::Mp4Writer(std::filesystem::path, const Mp4Settings&) { fail(); }
Mp4Writer::~Mp4Writer() = default;
void Mp4Writer::write(std::span<const std::uint8_t>, bool) { fail(); }
std::uint64_t Mp4Writer::frames() const { fail(); }
void Mp4Writer::finish() { fail(); }

}  // namespace sluice::media
