#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sluice/core/camera.h"
#include "sluice/core/stage_times.h"

namespace sluice::core {

using ViewerId = std::uint64_t;

/// What travels with a picture from the renderer to those who look at it.
struct FrameTag {
  std::uint64_t snapshotSequence = 0;
  double simulationTime = 0;  ///< s.
  bool still = false;         ///< Lossless, sent because nothing changed for a moment.
  StageTimes stages;          ///< What each stage spent on the frame, in order.
};

/// One viewer's share in a picture that may go to several.
struct Delivery {
  ViewerId viewer = 0;
  std::uint64_t frameId = 0;           ///< Rises by one with every frame of a viewer, from 1.
  std::uint64_t reflectsSequence = 0;  ///< Newest message of the viewer that the picture shows.
  std::uint64_t inReplyTo = 0;         ///< Not 0: the answer to a SnapshotRequest of that sequence number.
  /// When the message of `reflectsSequence` arrived; none where an earlier frame showed it already.
  std::optional<std::chrono::steady_clock::time_point> askedAt;
};

/// A picture: 8-bit sRGB, RGBA interleaved, rows from the top down without padding.
struct Frame {
  FrameTag tag;
  ImageSize size;
  std::vector<std::uint8_t> pixels;  ///< 4·width·height bytes.
};

enum class Codec : std::uint8_t { Jpeg, Png, H264, Vp9, Av1 };

/// Whether frames of this codec build on those before them, so that a viewer needs them all.
constexpr bool isVideo(Codec codec) { return codec != Codec::Jpeg && codec != Codec::Png; }

struct EncodedFrame {
  FrameTag tag;
  ImageSize size;
  Codec codec = Codec::Png;
  bool keyframe = true;  ///< Decodes without any other frame.
  int quality = 0;       ///< 1..100; 0 for lossless codecs.
  std::string decoder;   ///< Of a keyframe of video: what WebCodecs calls the stream, "avc1.42C01F".
  std::vector<std::uint8_t> bytes;
};

}  // namespace sluice::core
