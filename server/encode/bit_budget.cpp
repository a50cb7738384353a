#include "bit_budget.h"

#include <algorithm>
#include <cmath>

namespace sluice::encode {

BitBudget bitBudget(const EncoderSettings& settings, double nominalRate) {
  constexpr double kBufferSeconds = 0.2;
  constexpr double kLeastFrames = 1.5;
  const double bitsPerFrame = 1000.0 * settings.kilobitsPerSecond / settings.frameRate;
  const double bufferFrames = std::max(kBufferSeconds * settings.frameRate, kLeastFrames);
  return {std::llround(bitsPerFrame * nominalRate), std::llround(bitsPerFrame * bufferFrames)};
}

}  // namespace sluice::encode
