#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "sluice/core/check.h"
#include "sluice/core/frame.h"

namespace sluice::encode {

/// Runs `compress` (which gives the bytes) and wraps its result with the frame's tag, timed as the stage "encode".
template <class Compress>
core::EncodedFrame encodeTimed(const core::Frame& frame, core::Codec codec, Compress&& compress) {
  SLUICE_CHECK(frame.size.width > 0 && frame.size.height > 0);
  SLUICE_CHECK_EQ(frame.pixels.size(), 4U * static_cast<std::size_t>(frame.size.width) * frame.size.height);

  core::EncodedFrame encoded;
  encoded.tag = frame.tag;
  encoded.size = frame.size;
  encoded.codec = codec;
  const core::StageTimer timer(encoded.tag.stages, "encode");
  encoded.bytes = std::forward<Compress>(compress)();
  return encoded;
}

}  // namespace sluice::encode
