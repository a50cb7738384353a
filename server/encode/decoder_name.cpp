#include "decoder_name.h"

#include <algorithm>
#include <array>
#include <cstdio>

namespace sluice::encode {

namespace {

using Bytes = std::span<const std::uint8_t>;

/// Reads big-endian bit fields; beyond the end it reads zeros.
class BitReader {
 public:
  explicit BitReader(Bytes bytes) : bytes_(bytes) {}

  std::uint32_t read(int bits) {
    std::uint32_t value = 0;
    for (int i = 0; i < bits; ++i, ++position_) {
      const std::size_t byte = position_ / 8;
      const std::uint32_t bit = byte < bytes_.size() ? (bytes_[byte] >> (7 - position_ % 8)) & 1U : 0U;
      value = value << 1U | bit;
    }
    return value;
  }

 private:
  Bytes bytes_;
  std::size_t position_ = 0;
};

template <class... Values>
std::string format(const char* pattern, Values... values) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), pattern, values...);
  return text.data();
}

std::string h264Name(Bytes stream) {
  constexpr std::array<std::uint8_t, 3> kStartCode = {0, 0, 1};
  constexpr int kSequenceParameterSet = 7;
  auto at = stream.begin();
  while (true) {
    at = std::search(at, stream.end(), kStartCode.begin(), kStartCode.end());
    if (stream.end() - at < 7) return {};
    at += 3;
    if ((at[0] & 0x1F) == kSequenceParameterSet) return format("avc1.%02X%02X%02X", at[1], at[2], at[3]);
  }
}

/// Ten times the least VP9 level whose largest luma picture holds the size (VP9 levels, 2016).
unsigned vp9Level(core::ImageSize size) {
  struct Level {
    unsigned number;
    std::int64_t maxLumaPicture;
  };
  static constexpr auto kLevels = std::to_array<Level>({{10, 36864},
                                                        {11, 73728},
                                                        {20, 122880},
                                                        {21, 245760},
                                                        {30, 552960},
                                                        {31, 983040},
                                                        {41, 2228224},
                                                        {51, 8912896},
                                                        {61, 35651584}});
  const std::int64_t pixels = static_cast<std::int64_t>(size.width) * size.height;
  const auto level =
      std::find_if(kLevels.begin(), kLevels.end(), [&](const Level& l) { return pixels <= l.maxLumaPicture; });
  return level != kLevels.end() ? level->number : kLevels.back().number;
}

std::string vp9Name(Bytes frame, core::ImageSize size) {
  BitReader header(frame);
  constexpr unsigned kFrameMarker = 2;
  if (header.read(2) != kFrameMarker) return {};
  const unsigned low = header.read(1);
  const unsigned profile = header.read(1) * 2 + low;
  // 8 bits, 4:2:0 sited between the pixels, then BT.709's primaries, transfer and matrix, limited range.
  return format("vp09.%02u.%02u.08.00.01.01.01.00", profile, vp9Level(size));
}

struct Obu {
  unsigned type = 0;
  Bytes payload;
  Bytes rest;
};

/// The first open bitstream unit, low-overhead format with sizes (AV1, 5.3); type 0 where there is none.
Obu firstObu(Bytes bytes) {
  if (bytes.empty()) return {};
  const unsigned type = (bytes[0] >> 3U) & 0xFU;
  const bool hasExtension = (bytes[0] & 4U) != 0;
  const bool hasSize = (bytes[0] & 2U) != 0;
  std::size_t at = hasExtension ? 2 : 1;
  std::size_t size = 0;
  if (!hasSize) return {};
  for (unsigned shift = 0; at < bytes.size() && shift < 56; shift += 7) {
    const std::uint8_t byte = bytes[at++];
    size |= static_cast<std::size_t>(byte & 0x7FU) << shift;
    if ((byte & 0x80U) == 0) break;
  }
  if (at > bytes.size() || size > bytes.size() - at) return {};
  return {type, bytes.subspan(at, size), bytes.subspan(at + size)};
}

/// Level and tier of the first operating point (AV1, 5.5.1).
std::string av1SequenceName(BitReader header) {
  const unsigned profile = header.read(3);
  header.read(1);  // still_picture
  unsigned level = 0;
  unsigned tier = 0;
  if (header.read(1) != 0) {  // reduced_still_picture_header
    level = header.read(5);
  } else {
    if (header.read(1) != 0) return {};  // timing_info_present_flag: our encoders write none
    header.read(1);                      // initial_display_delay_present_flag
    header.read(5);                      // operating_points_cnt_minus_1
    header.read(12);                     // operating_point_idc
    level = header.read(5);
    constexpr unsigned kLastLevelWithoutTier = 7;
    if (level > kLastLevelWithoutTier) tier = header.read(1);
  }
  return format("av01.%u.%02u%c.08", profile, level, tier == 0 ? 'M' : 'H');
}

std::string av1Name(Bytes unit) {
  constexpr unsigned kSequenceHeader = 1;
  while (!unit.empty()) {
    const Obu obu = firstObu(unit);
    if (obu.type == kSequenceHeader) return av1SequenceName(BitReader(obu.payload));
    unit = obu.rest;
  }
  return {};
}

}  // namespace

std::string decoderName(core::Codec codec, Bytes keyframe, core::ImageSize size) {
  switch (codec) {
    case core::Codec::H264:
      return h264Name(keyframe);
    case core::Codec::Vp9:
      return vp9Name(keyframe, size);
    case core::Codec::Av1:
      return av1Name(keyframe);
    default:
      return {};
  }
}

}  // namespace sluice::encode
