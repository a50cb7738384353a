#pragma once

#include <cstdint>

#include "sluice/encode/frame_encoder.h"

namespace sluice::encode {

/// What the video buffering verifier of a stream allows: a bucket of `bufferBits` that fills at `bitsPerSecond`, half
/// full to begin with.
struct BitBudget {
  std::int64_t bitsPerSecond = 0;  ///< 0: no bound.
  std::int64_t bufferBits = 0;

  bool operator==(const BitBudget&) const = default;
};

/// The budget of an encoder that takes its frames to come at `nominalRate` a second, whatever rate the settings say:
/// the bits of a frame are those of the settings. The bucket holds what a fifth of a second brings, so that a keyframe
/// delays what follows by no more, or one frame and a half where frames are rarer.
BitBudget bitBudget(const EncoderSettings& settings, double nominalRate);

}  // namespace sluice::encode
