#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "sluice/core/camera.h"
#include "sluice/core/frame.h"

namespace sluice::encode {

/// What WebCodecs calls the stream that begins with this keyframe, read off its headers:
///   avc1.PPCCLL                  RFC 6381, profile, constraints and level of the sequence parameter set
///   (H.264, 7.3.2.1) vp09.PP.LL.DD.CC.cp.tc.mc.FF  "VP Codec ISO Media File Format Binding" 1.0; the level is the
///   least for the size av01.P.LLT.DD                "AV1 Codec ISO Media File Format Binding" 1.2, of the sequence
///   header (AV1, 5.5)
/// Empty where the headers are not found.
std::string decoderName(core::Codec codec, std::span<const std::uint8_t> keyframe, core::ImageSize size);

}  // namespace sluice::encode
