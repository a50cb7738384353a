#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "colour_map_pass.h"
#include "draw_legend.h"
#include "study_pass.h"

namespace sluice::render {

/// Draws what a picture's colours stand for over its final pixels. The legend of a kept picture is kept with it.
class LegendPass {
 public:
  /// `maps` and `study` have drawn the frame, or the picture that it keeps. `pixels` as in core::Frame.
  void run(const FrameContext& frame, const ColourMapPass& maps, const StudyPass& study,
           std::span<std::uint8_t> pixels);

 private:
  LegendEntries legendOf(const FrameContext& frame, const ColourMapPass& maps, const StudyPass& study);
  const std::vector<Rgb8>& coloursOf(v1::ColourMap::PaletteCase palette, const v1::Tone& tone);

  LegendEntries legend_;
  std::map<v1::ColourMap::PaletteCase, std::vector<Rgb8>> colours_;  ///< Under the last tone.
  v1::Tone toneOf_;
  Typeface typeface_;
};

}  // namespace sluice::render
