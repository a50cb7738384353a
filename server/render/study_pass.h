#pragma once

#include <map>
#include <optional>
#include <utility>

#include "value_colours.h"

namespace sluice::render {

/// Curvature times particle spacing that has the fullest colour: a ball of three spacings' radius.
inline constexpr float kFullCurvature = 1.0F / 3.0F;

/// A step of how the liquid is drawn, in place of the liquid: what scene.view() says.
class StudyPass {
 public:
  /// Begins the picture, plain grey: dark enough for every palette's lightest colour, and lighter than its darkest.
  /// Decides what the colours stand for, the same for all liquids.
  void begin(const FrameContext& frame);
  /// One liquid.
  void run(const FrameContext& frame);
  /// Foam over all of them.
  void runFoam(const FrameContext& frame);

  /// What the colours of the last picture stand for: m, of curvature 1/d.
  ValueRange range() const { return range_; }

 private:
  ColourTable palette_;
  ValueRange range_;
  v1::View::ShowsCase rangeOf_ = v1::View::SHOWS_NOT_SET;
  std::optional<gl::Program> foam_;
  std::map<std::pair<std::string_view, bool>, gl::Program>
      programs_;  ///< By flag, and whether there are several liquids.
};

/// The colours of a view's values.
v1::ColourMap::PaletteCase paletteOf(const v1::View& view);

/// The scene that a view draws: a study leaves the tone of its colours alone, draws every particle by itself where it
/// shows particles, and has foam only where it shows foam.
v1::Scene forItsView(const v1::Scene& scene);

}  // namespace sluice::render
