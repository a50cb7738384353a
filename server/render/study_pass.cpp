#include "study_pass.h"

#include <array>

namespace sluice::render {

namespace {

std::string_view flagOf(const v1::View& view) {
  switch (view.shows_case()) {
    case v1::View::kRawDepth:
    case v1::View::kSmoothedDepth:
      return "DEPTH";
    case v1::View::kNormals:
      return "NORMALS";
    case v1::View::kCurvature:
      return "CURVATURE";
    case v1::View::kThickness:
      return "THICKNESS";
    default:
      return "LIT";
  }
}

/// The values of a picture that are not 0, each made `of` it.
template <class Of>
std::vector<float> valuesOfPicture(std::span<const float> picture, const Of& of) {
  std::vector<float> values;
  for (const float value : picture) {
    if (value > 0.0F) values.push_back(of(value));
  }
  return values;
}

}  // namespace

bool isStudy(const v1::View& view) {
  return view.shows_case() != v1::View::kPicture && view.shows_case() != v1::View::SHOWS_NOT_SET;
}

v1::Scene forItsView(const v1::Scene& scene) {
  v1::Scene shown = scene;
  if (!isStudy(scene.view())) return shown;
  shown.mutable_tone()->set_exposure(0);
  shown.mutable_tone()->mutable_clip();
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

void beginStudy(const FrameContext& frame) {
  constexpr std::array<GLfloat, 4> kGrey{0.07F, 0.07F, 0.075F, 1.0F};
  beginTarget(frame, Resource::Picture);
  glClearBufferfv(GL_COLOR, 0, kGrey.data());
}

void StudyPass::run(const FrameContext& frame) {
  const v1::View& view = frame.scene.view();
  const std::string_view flag = flagOf(view);
  const bool layered = frame.plan.layers > 1;
  auto program = programs_.find({flag, layered});
  if (program == programs_.end()) {
    std::vector<std::string_view> defines{flag};
    if (layered) defines.emplace_back("LAYERED");
    program =
        programs_.emplace(std::pair(flag, layered), shaders().program("picture.vert", "study.frag", defines)).first;
  }
  const ValueRange former = range_;
  const ValueRange* const previous = rangeOf_ == view.shows_case() ? &former : nullptr;
  rangeOf_ = view.shows_case();
  ViewGeometry values = frame.surfaceView;
  if (flag == "DEPTH") {
    const auto depths = valuesOfPicture(frame.targets.read(Resource::Surface), [](float q) { return 1.0F / q; });
    range_ = robustRange(depths, false, previous);
  } else if (flag == "THICKNESS") {
    values = frame.thicknessView;
    auto thickness = valuesOfPicture(frame.targets.read(Resource::Thickness), [](float t) { return t; });
    const ValueRange measured = robustRange(thickness, false);
    range_ = previous != nullptr && measured.most <= previous->most && measured.most >= 0.5F * previous->most
                 ? *previous
                 : ValueRange{0.0F, measured.most};
    bindTexture(frame, 1, Resource::Thickness);
  } else {
    range_ = {-kFullCurvature, kFullCurvature};
  }
  palette_.usePalette(v1::ColourMap::kViridis, frame.scene.tone());
  palette_.bind(2);
  beginOverPicture(frame, program->second);
  setRange(program->second, flag == "CURVATURE" ? ValueRange{0.0F, kFullCurvature} : range_, 1.0F, values);
  drawPicture();
}

}  // namespace sluice::render
