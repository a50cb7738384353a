#include "sluice/client/peak_signal_to_noise.h"

#include <cmath>
#include <limits>

namespace sluice::client {

std::optional<double> peakSignalToNoise(const Picture& picture, const Picture& reference) {
  if (picture.width != reference.width || picture.height != reference.height) return std::nullopt;
  if (picture.rgba.empty()) return std::nullopt;
  constexpr std::size_t kChannels = 4;
  constexpr std::size_t kAlpha = 3;
  double squares = 0;
  for (std::size_t i = 0; i < picture.rgba.size(); ++i) {
    if (i % kChannels == kAlpha) continue;
    const int difference = std::to_integer<int>(picture.rgba[i]) - std::to_integer<int>(reference.rgba[i]);
    squares += difference * difference;
  }
  if (squares == 0) return std::numeric_limits<double>::infinity();
  const double samples = 3.0 * static_cast<double>(picture.rgba.size() / kChannels);
  return 10 * std::log10(255.0 * 255.0 * samples / squares);
}

}  // namespace sluice::client
