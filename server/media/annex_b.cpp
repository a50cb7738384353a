#include "annex_b.h"

#include <algorithm>
#include <array>

namespace sluice::media {

namespace {

constexpr std::array<std::uint8_t, 3> kStartCode = {0, 0, 1};
constexpr int kSequenceParameterSet = 7;
constexpr int kPictureParameterSet = 8;

}  // namespace

std::vector<std::uint8_t> parameterSets(std::span<const std::uint8_t> annexB) {
  std::vector<std::uint8_t> sets;
  auto start = std::search(annexB.begin(), annexB.end(), kStartCode.begin(), kStartCode.end());
  while (annexB.end() - start > 3) {
    const auto unit = start + 3;
    const auto next = std::search(unit, annexB.end(), kStartCode.begin(), kStartCode.end());
    // The zero byte before a start code belongs to it; a NAL unit ends in a byte that is not 0 (7.4.1).
    auto end = next;
    while (end != unit && *(end - 1) == 0) --end;
    const int type = end != unit ? *unit & 0x1F : 0;
    if (type == kSequenceParameterSet || type == kPictureParameterSet) {
      sets.insert(sets.end(), {0, 0, 0, 1});
      sets.insert(sets.end(), unit, end);
    }
    start = next;
  }
  return sets;
}

}  // namespace sluice::media
