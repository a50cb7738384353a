#pragma once

#include <optional>

#include "sluice/client/frame_decoder.h"

namespace sluice::client {

/// 10·log10(255² / mean squared difference) over red, green and blue, dB; infinite for equal pictures, none for
/// pictures of different sizes or of no pixels.
std::optional<double> peakSignalToNoise(const Picture& picture, const Picture& reference);

}  // namespace sluice::client
