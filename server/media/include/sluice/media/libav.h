#pragma once

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/error.h>
#include <libavutil/frame.h>
}

#include <memory>
#include <string>

// Owners of FFmpeg's objects, for modules that call it. Present only in builds with SLUICE_VIDEO.

namespace sluice::media {

struct FreeLibav {
  void operator()(AVCodecContext* context) const { avcodec_free_context(&context); }
  void operator()(AVFrame* frame) const { av_frame_free(&frame); }
  void operator()(AVPacket* packet) const { av_packet_free(&packet); }
  void operator()(AVFormatContext* context) const {
    if (context->pb != nullptr && context->oformat != nullptr) avio_closep(&context->pb);
    avformat_free_context(context);
  }
  void operator()(AVBufferRef* buffer) const { av_buffer_unref(&buffer); }
};

using CodecContext = std::unique_ptr<AVCodecContext, FreeLibav>;
using FramePtr = std::unique_ptr<AVFrame, FreeLibav>;
using PacketPtr = std::unique_ptr<AVPacket, FreeLibav>;
using OutputContext = std::unique_ptr<AVFormatContext, FreeLibav>;
using BufferRef = std::unique_ptr<AVBufferRef, FreeLibav>;

// Each throws core::EnvironmentError where there is no memory.
CodecContext makeCodecContext(const AVCodec* codec);
FramePtr makeFrame();
PacketPtr makePacket();

/// FFmpeg's words for one of its error numbers.
std::string libavError(int error);

/// FFmpeg writes its log to stderr: from now on of the whole process only what it cannot go on after. Thread-safe.
void quietLibav();

}  // namespace sluice::media
