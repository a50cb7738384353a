#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "sluice/core/frame.h"

namespace sluice::render {

/// A character as pixels.
struct Glyph {
  core::ImageSize size;
  int left = 0;                        ///< From the pen to the first column, pixels.
  int above = 0;                       ///< From the base line up to the first row, pixels.
  int advance = 0;                     ///< From this pen to the next one's, pixels.
  std::vector<std::uint8_t> coverage;  ///< Share of each pixel, 0 to 255, row by row from the top.
};

/// DejaVu Sans [Bitstream Vera; dejavu-fonts.org], which the program carries. Glyphs are drawn once for every size. Of
/// one thread at a time.
class Typeface {
 public:
  Typeface();
  ~Typeface();
  Typeface(const Typeface&) = delete;
  Typeface& operator=(const Typeface&) = delete;

  /// `pixels` is the size of the em, > 0. Characters that the font lacks are drawn as its box for them.
  const Glyph& glyph(char32_t character, int pixels);

  /// How far the pen moves over a line of text, pixels.
  int widthOf(std::string_view utf8, int pixels);

 private:
  struct Font;

  std::unique_ptr<Font> font_;
  std::map<std::pair<int, char32_t>, Glyph> glyphs_;
};

/// The characters of valid UTF-8.
std::vector<char32_t> charactersOf(std::string_view utf8);

}  // namespace sluice::render
