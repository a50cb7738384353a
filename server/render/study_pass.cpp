#include "study_pass.h"

#include <array>
#include <functional>

namespace sluice::render {

namespace {

std::string_view flagOf(const FrameContext& frame) {
  switch (frame.scene.view().shows_case()) {
    case v1::View::kRawDepth:
    case v1::View::kSmoothedDepth:
      return "DEPTH";
    case v1::View::kNormals:
      return "NORMALS";
    case v1::View::kCurvature:
      return "CURVATURE";
    case v1::View::kThickness:
      return "VALUES";
    case v1::View::kNoise:
      return frame.plan.runs(Pass::Noise, frame.liquid) ? "VALUES" : "GREY";
    case v1::View::kFoam:
      return "LEAST";
    default:
      return "LIT";
  }
}

/// What is not 0 in a buffer of each liquid, each value made `of` it.
template <class Of>
std::vector<float> valuesOfLiquids(const FrameContext& frame, Resource resource, const Of& of) {
  std::vector<float> values;
  for (std::size_t k = 0; k < frame.plan.surfaces.size(); ++k) {
    const BufferId buffer{resource, static_cast<std::uint8_t>(k)};
    if (frame.plan.buffer(buffer) == nullptr) continue;
    for (const float value : frame.targets.read(buffer)) {
      if (value != 0.0F) values.push_back(of(value));
    }
  }
  return values;
}

/// `previous` is what the colours of the last picture of this view stood for; null for the first.
ValueRange rangeOf(const FrameContext& frame, const ValueRange* previous) {
  switch (frame.scene.view().shows_case()) {
    case v1::View::kRawDepth:
    case v1::View::kSmoothedDepth:
      return robustRange(valuesOfLiquids(frame, Resource::Surface, [](float q) { return 1.0F / q; }), false, previous);
    case v1::View::kThickness: {
      const float most = robustRange(valuesOfLiquids(frame, Resource::Thickness, std::identity()), false).most;
      if (previous != nullptr && most <= previous->most && most >= 0.5F * previous->most) return *previous;
      return {0.0F, most};
    }
    case v1::View::kNoise:
      return robustRange(valuesOfLiquids(frame, Resource::Noise, std::identity()), true, previous);
    case v1::View::kCurvature:
      return {-kFullCurvature, kFullCurvature};
    default:
      return {};
  }
}

}  // namespace

bool isStudy(const v1::View& view) {
  return view.shows_case() != v1::View::kPicture && view.shows_case() != v1::View::SHOWS_NOT_SET;
}

bool showsValues(const v1::View& view) { return isStudy(view) && !view.has_spheres() && !view.has_points(); }

v1::Scene forItsView(const v1::Scene& scene) {
  v1::Scene shown = scene;
  if (!isStudy(scene.view())) return shown;
  shown.mutable_tone()->set_exposure(0);
  shown.mutable_tone()->mutable_clip();
  if (!scene.view().has_foam()) shown.clear_foam();
  const auto adapt = [&](v1::Look& look) {
    const v1::View& view = scene.view();
    if (!view.has_spheres() && !view.has_points()) return;
    v1::Splats& splats = *look.mutable_splats();
    splats.mutable_sphere();
    splats.set_radius_by_density(false);
    splats.set_stray_density(0);
    // Half a spacing: spheres that touch each other; points are a fifth of that.
    splats.set_radius_in_spacings(view.has_points() ? 0.1 : 0.5);
    look.mutable_smoothing()->set_divisor(1);
  };
  adapt(*shown.mutable_look());
  for (v1::Look& look : *shown.mutable_more_looks()) adapt(look);
  return shown;
}

v1::ColourMap::PaletteCase paletteOf(const v1::View& view) {
  if (view.has_noise()) return v1::ColourMap::kCoolWarm;
  // Black to white, as foam is.
  if (view.has_foam()) return v1::ColourMap::kMagma;
  return v1::ColourMap::kViridis;
}

void StudyPass::begin(const FrameContext& frame) {
  constexpr std::array<GLfloat, 4> kGrey{0.07F, 0.07F, 0.075F, 1.0F};
  beginTarget(frame, Resource::Picture);
  glClearBufferfv(GL_COLOR, 0, kGrey.data());
  const v1::View& view = frame.scene.view();
  const ValueRange former = range_;
  range_ = rangeOf(frame, rangeOf_ == view.shows_case() ? &former : nullptr);
  rangeOf_ = view.shows_case();
  palette_.usePalette(paletteOf(view), frame.scene.tone());
}

void StudyPass::run(const FrameContext& frame) {
  const v1::View& view = frame.scene.view();
  const std::string_view flag = flagOf(frame);
  const bool layered = frame.plan.layers > 1;
  auto program = programs_.find({flag, layered});
  if (program == programs_.end()) {
    std::vector<std::string_view> defines{flag};
    if (layered) defines.emplace_back("LAYERED");
    program =
        programs_.emplace(std::pair(flag, layered), shaders().program("picture.vert", "study.frag", defines)).first;
  }
  if (flag == "VALUES") bindTexture(frame, 1, view.has_noise() ? Resource::Noise : Resource::Thickness);
  palette_.bind(2);
  beginOverPicture(frame, program->second);
  setRange(program->second, flag == "CURVATURE" ? ValueRange{0.0F, kFullCurvature} : range_, 1.0F,
           view.has_thickness() ? frame.thicknessView : frame.surfaceView);
  drawPicture();
}

void StudyPass::runFoam(const FrameContext& frame) {
  if (!foam_) foam_ = shaders().program("picture.vert", "study_foam.frag");
  beginTarget(frame, Resource::Picture);
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  // Colours come multiplied by their coverage.
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  bindTexture(frame, 0, Resource::Foam);
  palette_.bind(2);
  glUseProgram(foam_->name());
  drawPicture();
}

}  // namespace sluice::render
