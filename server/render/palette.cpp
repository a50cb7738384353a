#include "palette.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace sluice::render {

namespace {

/// Colours at equal steps, 0xRRGGBB, sRGB-encoded. Straight lines between them leave the published tables of 256 by at
/// most five levels of eight bits.
using Table = std::array<std::uint32_t, 33>;

// van der Walt & Smith 2015, matplotlib.
constexpr Table kViridis{
    0x440154, 0x470d60, 0x48186a, 0x482374, 0x472d7b, 0x453781, 0x424086, 0x3e4989, 0x3b528b, 0x375b8d, 0x33638d,
    0x2f6b8e, 0x2c728e, 0x297a8e, 0x26828e, 0x23898e, 0x21908c, 0x1f978b, 0x1f9f88, 0x21a685, 0x27ad81, 0x31b57b,
    0x3ebc74, 0x4dc26c, 0x5cc863, 0x6ece58, 0x82d34d, 0x95d840, 0xaadc32, 0xc0df25, 0xd5e21a, 0xeae51a, 0xfde725,
};
// van der Walt & Smith 2015, matplotlib.
constexpr Table kMagma{
    0x000004, 0x030312, 0x0a0822, 0x130d34, 0x1d1147, 0x29115a, 0x36106b, 0x440f76, 0x50127c, 0x5d177f, 0x691c81,
    0x762181, 0x822681, 0x8f2a81, 0x9c2e7f, 0xa9337d, 0xb6367a, 0xc33b75, 0xcf4070, 0xdb476a, 0xe65164, 0xee5c5e,
    0xf46a5c, 0xf9785d, 0xfb8861, 0xfd9668, 0xfea571, 0xfeb47b, 0xfec287, 0xfed194, 0xfde0a1, 0xfceeb0, 0xfcfdbf,
};
// Nuñez, Anderton & Renslow 2018, by Bostock's polynomials.
constexpr Table kCividis{
    0x002051, 0x00265d, 0x012b65, 0x083169, 0x11366c, 0x1c3c6e, 0x26426e, 0x31476e, 0x3c4d6e, 0x47536d, 0x51586e,
    0x5a5e6e, 0x62646f, 0x6a6a70, 0x727071, 0x797673, 0x7f7c75, 0x868276, 0x8c8877, 0x938e78, 0x9a9478, 0xa19b78,
    0xa9a177, 0xb2a874, 0xbbaf71, 0xc5b66d, 0xcebd68, 0xd8c462, 0xe2cb5c, 0xebd355, 0xf3da4f, 0xfae249, 0xfdea45,
};
// Moreland 2009: from (59, 76, 192) to (180, 4, 38) through M = 88 of his Msh space.
constexpr Table kCoolWarm{
    0x3b4cc0, 0x445acc, 0x4e68d7, 0x5875e1, 0x6282ea, 0x6c8ef1, 0x779af7, 0x82a5fb, 0x8db0fe, 0x98b9ff, 0xa3c2ff,
    0xaec9fd, 0xb8d0f9, 0xc2d5f4, 0xccd9ee, 0xd5dbe6, 0xdddddd, 0xe5d8d1, 0xecd3c6, 0xf1ccb9, 0xf5c4ad, 0xf7bba0,
    0xf7b194, 0xf7a687, 0xf49a7b, 0xf18d6f, 0xec7f63, 0xe57057, 0xde614c, 0xd55042, 0xcb3e38, 0xc0282f, 0xb40426,
};
// Mikhailov 2019, by his polynomials.
constexpr Table kTurbo{
    0x23171b, 0x3e2a71, 0x493eae, 0x4a53d7, 0x4569ee, 0x3c7ff8, 0x3295f7, 0x2ba9ef, 0x26bce1, 0x25cdcf, 0x29dcbc,
    0x32e9a7, 0x3ff393, 0x50f980, 0x65fd6e, 0x7cfd5e, 0x95fb51, 0xadf545, 0xc5ec3c, 0xdae034, 0xecd12e, 0xfac029,
    0xffad24, 0xff9821, 0xff821d, 0xfd6c1a, 0xf05616, 0xdf4111, 0xcb2f0d, 0xb61f07, 0xa31302, 0x950c00, 0x900c00,
};

const Table& tableOf(v1::ColourMap::PaletteCase palette) {
  switch (palette) {
    case v1::ColourMap::kMagma:
      return kMagma;
    case v1::ColourMap::kCividis:
      return kCividis;
    case v1::ColourMap::kCoolWarm:
      return kCoolWarm;
    case v1::ColourMap::kTurbo:
      return kTurbo;
    case v1::ColourMap::kViridis:
    case v1::ColourMap::PALETTE_NOT_SET:
      break;
  }
  return kViridis;
}

Eigen::Vector3f colourOf(std::uint32_t hex) {
  return Eigen::Vector3f(static_cast<float>(hex >> 16), static_cast<float>((hex >> 8) & 0xFF),
                         static_cast<float>(hex & 0xFF)) /
         255.0F;
}

}  // namespace

Eigen::Vector3f paletteColour(v1::ColourMap::PaletteCase palette, float share) {
  const Table& table = tableOf(palette);
  const float place = std::clamp(share, 0.0F, 1.0F) * static_cast<float>(table.size() - 1);
  const std::size_t before = std::min(static_cast<std::size_t>(place), table.size() - 2);
  const float rest = place - static_cast<float>(before);
  return (1.0F - rest) * colourOf(table[before]) + rest * colourOf(table[before + 1]);
}

float linearOfSrgb(float encoded) {
  return encoded <= 0.04045F ? encoded / 12.92F : std::pow((encoded + 0.055F) / 1.055F, 2.4F);
}

float lightness(const Eigen::Vector3f& srgb) {
  // Y of linear sRGB; below (6/29)³ the cube root is replaced by its tangent.
  const float luminance =
      0.2126F * linearOfSrgb(srgb.x()) + 0.7152F * linearOfSrgb(srgb.y()) + 0.0722F * linearOfSrgb(srgb.z());
  return luminance > 0.008856F ? 116.0F * std::cbrt(luminance) - 16.0F : 903.3F * luminance;
}

}  // namespace sluice::render
