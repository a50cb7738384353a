#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace sluice::media {

/// The parameter sets (NAL units of type 7 and 8) of H.264 in the byte stream format of ITU-T H.264 Annex B, each with
/// a start code of four bytes.
std::vector<std::uint8_t> parameterSets(std::span<const std::uint8_t> annexB);

}  // namespace sluice::media
