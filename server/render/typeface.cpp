#include "typeface.h"

#include <ft2build.h>

#include "sluice/core/check.h"
#include "sluice/render/embedded_font.h"
#include FT_FREETYPE_H

namespace sluice::render {

struct Typeface::Font {
  Font() {
    SLUICE_CHECK_EQ(FT_Init_FreeType(&library), 0);
    const std::span<const unsigned char> bytes = embeddedFont();
    SLUICE_CHECK_EQ(FT_New_Memory_Face(library, bytes.data(), static_cast<FT_Long>(bytes.size()), 0, &face), 0);
  }
  ~Font() { FT_Done_FreeType(library); }  // and its faces
  Font(const Font&) = delete;
  Font& operator=(const Font&) = delete;

  FT_Library library = nullptr;
  FT_Face face = nullptr;
};

Typeface::Typeface() : font_(std::make_unique<Font>()) {}
Typeface::~Typeface() = default;

const Glyph& Typeface::glyph(char32_t character, int pixels) {
  const auto [entry, isNew] = glyphs_.try_emplace({pixels, character});
  Glyph& glyph = entry->second;
  if (!isNew) return glyph;
  FT_Face face = font_->face;
  SLUICE_CHECK_EQ(FT_Set_Pixel_Sizes(face, 0, static_cast<FT_UInt>(pixels)), 0);
  // Fitted to rows of pixels alone: small text is crisp, and its letters keep their shapes.
  SLUICE_CHECK_EQ(FT_Load_Char(face, character, FT_LOAD_RENDER | FT_LOAD_TARGET_LIGHT), 0);
  const FT_GlyphSlot slot = face->glyph;
  const FT_Bitmap& bitmap = slot->bitmap;
  glyph.size = {static_cast<int>(bitmap.width), static_cast<int>(bitmap.rows)};
  glyph.left = slot->bitmap_left;
  glyph.above = slot->bitmap_top;
  glyph.advance = static_cast<int>(slot->advance.x >> 6);  // of 1/64 pixels
  for (int y = 0; y < glyph.size.height; ++y) {
    const unsigned char* const row = bitmap.buffer + static_cast<std::ptrdiff_t>(y) * bitmap.pitch;
    glyph.coverage.insert(glyph.coverage.end(), row, row + glyph.size.width);
  }
  return glyph;
}

int Typeface::widthOf(std::string_view utf8, int pixels) {
  int width = 0;
  for (const char32_t character : charactersOf(utf8)) width += glyph(character, pixels).advance;
  return width;
}

std::vector<char32_t> charactersOf(std::string_view utf8) {
  std::vector<char32_t> characters;
  for (const char c : utf8) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80) {
      characters.push_back(byte);
    } else if (byte < 0xC0) {
      // Six more bits of the character at hand.
      SLUICE_CHECK(!characters.empty());
      characters.back() = characters.back() << 6 | (byte & 0x3FU);
    } else {
      // The first of two, three or four bytes tells how many by its leading ones.
      characters.push_back(byte < 0xE0 ? byte & 0x1FU : byte < 0xF0 ? byte & 0x0FU : byte & 0x07U);
    }
  }
  return characters;
}

}  // namespace sluice::render
