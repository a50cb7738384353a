#include "sluice/media/libav.h"

#include <array>
#include <mutex>

#include "sluice/core/input_error.h"

namespace sluice::media {

namespace {

template <class T>
std::unique_ptr<T, FreeLibav> owned(T* object) {
  if (object == nullptr) throw core::EnvironmentError("FFmpeg: out of memory");
  return std::unique_ptr<T, FreeLibav>(object);
}

}  // namespace

CodecContext makeCodecContext(const AVCodec* codec) { return owned(avcodec_alloc_context3(codec)); }
FramePtr makeFrame() { return owned(av_frame_alloc()); }
PacketPtr makePacket() { return owned(av_packet_alloc()); }

std::string libavError(int error) {
  std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
  av_strerror(error, text.data(), text.size());
  return text.data();
}

void quietLibav() {
  static std::once_flag once;
  std::call_once(once, [] { av_log_set_level(AV_LOG_FATAL); });
}

}  // namespace sluice::media
