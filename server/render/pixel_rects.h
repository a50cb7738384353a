#pragma once

#include <span>
#include <vector>

#include <epoxy/gl.h>

#include "sluice/core/camera.h"

namespace sluice::render {

/// Pixels of a picture, from its top left corner.
struct PixelRect {
  int left = 0, top = 0, width = 0, height = 0;

  int right() const { return left + width; }   ///< The first column beyond.
  int bottom() const { return top + height; }  ///< The first row beyond.
  bool isEmpty() const { return width <= 0 || height <= 0; }
  bool meets(const PixelRect& other) const {
    return left < other.right() && other.left < right() && top < other.bottom() && other.top < bottom();
  }
  bool operator==(const PixelRect&) const = default;
};

/// Rectangles that cover the same pixels, and maybe more, none of them twice.
std::vector<PixelRect> disjoint(std::vector<PixelRect> rects);

/// Rectangles that cover the rest of a picture, none of it twice.
std::vector<PixelRect> complement(std::span<const PixelRect> rects, core::ImageSize size);

/// Draws into these pixels alone, as long as it lives.
class KeepTo {
 public:
  explicit KeepTo(const PixelRect& rect) {
    glEnable(GL_SCISSOR_TEST);
    glScissor(rect.left, rect.top, rect.width, rect.height);
  }
  ~KeepTo() { glDisable(GL_SCISSOR_TEST); }
  KeepTo(const KeepTo&) = delete;
  KeepTo& operator=(const KeepTo&) = delete;
};

}  // namespace sluice::render
