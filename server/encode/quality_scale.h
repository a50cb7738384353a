#pragma once

#include "sluice/core/frame.h"

namespace sluice::encode {

/// The constant quality of a video codec, in its own unit (the rate factor of x264, 0..51; the quantiser level of VP9
/// and AV1, 0..63), that gives about the fidelity of JPEG of `quality` 1..100: equal PSNR of the luma over pictures of
/// breaking water, measured with the encoders' settings here.
double constantQuality(core::Codec codec, int quality);

}  // namespace sluice::encode
