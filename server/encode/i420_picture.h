#pragma once

#include <cstdint>

#include "sluice/core/camera.h"

namespace sluice::encode {

/// Planes of an 8-bit 4:2:0 picture in memory that its owner provides; strides in bytes. Of w×h pixels the luma has
/// w columns, each chroma plane ⌈w/2⌉ columns and ⌈h/2⌉ rows.
struct I420Planes {
  std::uint8_t* y;
  std::uint8_t* u;
  std::uint8_t* v;
  int strideY;
  int strideU;
  int strideV;
};

/// RGBA without padding between rows to Y'CbCr of ITU-R BT.709-6, items 3.2 to 3.4, in the limited range of its item
/// 4.6. Each chroma sample is the mean of the 2×2 pixels around it (sited in their centre), at odd edges of those that
/// there are. The planes may be one larger than `size` (`codedSize`): the last column or row is then repeated.
void toI420(const std::uint8_t* rgba, core::ImageSize size, core::ImageSize codedSize, const I420Planes& planes);

}  // namespace sluice::encode
