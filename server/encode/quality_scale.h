#pragma once

#include "sluice/core/frame.h"

namespace sluice::encode {

/// The constant quality of a video codec, in its own unit (the rate factor of x264, 0..51; the quantiser level of VP9
/// and AV1, 0..63), for a quality 1..100. It falls as the quality rises; 80 is the customary 23 of x264 and 31 of VP9
/// and AV1. The codecs are not matched by measured fidelity.
double constantQuality(core::Codec codec, int quality);

}  // namespace sluice::encode
