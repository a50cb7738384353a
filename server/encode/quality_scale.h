#pragma once

#include "sluice/core/frame.h"

namespace sluice::encode {

/// The constant quality of a video codec, in its own unit (the rate factor of x264, 0..51; the quantiser level of VP9
/// and AV1, 0..63), for a quality 1..100. It never rises with the quality; 80 is the customary 23 of x264. The scales
/// of VP9 and AV1 are set so that luma of a picture of moving water comes to x264's PSNR at the same quality, within 1
/// dB from 20 to 90 (`bench_quality`; figures in docs/codecs.md). Below 20 VP9 has no coarser quantiser left.
double constantQuality(core::Codec codec, int quality);

}  // namespace sluice::encode
