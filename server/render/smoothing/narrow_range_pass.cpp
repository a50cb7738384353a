#include <array>
#include <cmath>
#include <string_view>

#include "smoothing/smoothing_method.h"
#include "smoothing/surface_turns.h"

namespace sluice::render {

namespace {

/// Share of the smoothing time that the last disc takes: σ/8, 2 to 3 pixels where a spacing is 8 to 10 pixels wide, as
/// large as Truong & Yuksel's own disc of 4 pixels radius.
constexpr double kDiscShare = 1.0 / 64;

constexpr std::array<std::string_view, 1> kDisc{"DISC"};

class NarrowRangePass final : public SmoothingMethod {
 public:
  void run(const FrameContext& frame) override {
    const v1::Smoothing& smoothing = frame.look.smoothing();
    const v1::NarrowRange& method = smoothing.narrow_range();
    const double deviation = smoothingDeviation(smoothing, frame.scale.spacing);
    for (const gl::Program* const program : {&axis_, &disc_}) {
      glProgramUniform1f(program->name(), 2, static_cast<float>(method.range_in_radii() * frame.scale.radius));
      glProgramUniform1f(program->name(), 3, static_cast<float>(method.beyond_in_radii() * frame.scale.radius));
    }
    // Variances add up.
    glProgramUniform1f(axis_.name(), 1,
                       static_cast<float>(deviation * std::sqrt((1 - kDiscShare) / method.iterations())));
    glProgramUniform1f(disc_.name(), 1, static_cast<float>(deviation * std::sqrt(kDiscShare)));
    SurfaceTurns turns(frame);
    for (unsigned i = 0; i < method.iterations(); ++i) turns.drawAlongAxes(axis_);
    turns.draw(disc_);
    turns.finish();
  }

 private:
  gl::Program axis_ = shaders().program("picture.vert", "narrow_range.frag");
  gl::Program disc_ = shaders().program("picture.vert", "narrow_range.frag", kDisc);
};

}  // namespace

SmoothingPlan planNarrowRange(const v1::Smoothing& smoothing, const SurfaceTraits&) {
  return {.scratch = 1, .mask = true, .sweeps = static_cast<int>(2 * smoothing.narrow_range().iterations() + 1)};
}

std::unique_ptr<SmoothingMethod> makeNarrowRange() { return std::make_unique<NarrowRangePass>(); }

}  // namespace sluice::render
