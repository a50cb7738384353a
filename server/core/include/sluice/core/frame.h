#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sluice/core/camera.h"
#include "sluice/core/stage_times.h"

namespace sluice::core {

using ViewerId = std::uint64_t;

/// What travels with a picture from the renderer to its viewer.
struct FrameTag {
  ViewerId viewer = 0;
  std::uint64_t frameId = 0;           ///< Rises by one with every frame of a viewer, from 1.
  std::uint64_t reflectsSequence = 0;  ///< Newest message of the viewer that the picture shows.
  std::uint64_t snapshotSequence = 0;
  double simulationTime = 0;    ///< s.
  std::uint64_t inReplyTo = 0;  ///< Not 0: the answer to a SnapshotRequest of that sequence number.
  StageTimes stages;            ///< What each stage spent on the frame, in order.
};

/// A picture: 8-bit sRGB, RGBA interleaved, rows from the top down without padding.
struct Frame {
  FrameTag tag;
  ImageSize size;
  std::vector<std::uint8_t> pixels;  ///< 4·width·height bytes.
};

enum class Codec : std::uint8_t { Jpeg, Png };

struct EncodedFrame {
  FrameTag tag;
  ImageSize size;
  Codec codec = Codec::Png;
  bool keyframe = true;  ///< Decodes without any other frame.
  std::vector<std::uint8_t> bytes;
};

}  // namespace sluice::core
