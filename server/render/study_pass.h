#pragma once

#include <map>
#include <utility>

#include "value_colours.h"

namespace sluice::render {

/// Curvature times particle spacing that has the fullest colour: a ball of three spacings' radius.
inline constexpr float kFullCurvature = 1.0F / 3.0F;

/// A step of how the liquid is drawn, in place of the liquid: what scene.view() says.
class StudyPass {
 public:
  void run(const FrameContext& frame);

  /// What the colours of the last picture stand for.
  ValueRange range() const { return range_; }

 private:
  ColourTable palette_;
  ValueRange range_;
  v1::View::ShowsCase rangeOf_ = v1::View::SHOWS_NOT_SET;
  std::map<std::pair<std::string_view, bool>, gl::Program>
      programs_;  ///< By flag, and whether there are several liquids.
};

/// Plain grey, before which studies stand: dark enough for every palette's lightest colour, and lighter than its
/// darkest.
void beginStudy(const FrameContext& frame);

/// The scene that a view draws: a study leaves the tone of its colours alone, and draws every particle by itself where
/// it shows particles.
v1::Scene forItsView(const v1::Scene& scene);

}  // namespace sluice::render
