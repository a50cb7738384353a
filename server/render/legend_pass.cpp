#include "legend_pass.h"

#include <string>
#include <utility>

#include "same.h"

namespace sluice::render {

LegendEntries LegendPass::legendOf(const FrameContext& frame, const ColourMapPass& maps, const StudyPass& study) {
  const v1::Scene& scene = frame.scene;
  const v1::View& view = scene.view();
  if (showsValues(view)) {
    const auto spacing = static_cast<double>(frame.scale.spacing);
    return {studyEntry(view, study.range(), spacing, coloursOf(paletteOf(view), scene.tone()))};
  }
  std::vector<std::size_t> coloured;
  for (std::size_t k = 0; k < frame.plan.surfaces.size(); ++k) {
    if (frame.plan.runs(Pass::ColourMap, k)) coloured.push_back(k);
  }
  LegendEntries legend;
  for (const std::size_t k : coloured) {
    const v1::ColourMap& map = lookOf(scene, k).colour_map();
    const ValueRange range = maps.range(static_cast<std::uint8_t>(k));
    ColourBar bar = colourMapBar(map, range, coloursOf(map.palette_case(), scene.tone()));
    if (coloured.size() > 1) bar.title += ", liquid " + std::to_string(k + 1);
    legend.emplace_back(std::move(bar));
  }
  return legend;
}

const std::vector<Rgb8>& LegendPass::coloursOf(v1::ColourMap::PaletteCase palette, const v1::Tone& tone) {
  if (!same(toneOf_, tone)) {
    colours_.clear();
    toneOf_ = tone;
  }
  const auto [entry, isNew] = colours_.try_emplace(palette);
  if (isNew) entry->second = shownColours(palette, tone);
  return entry->second;
}

void LegendPass::run(const FrameContext& frame, const ColourMapPass& maps, const StudyPass& study,
                     std::span<std::uint8_t> pixels) {
  // A picture that is kept has nothing to begin, and its ranges are those of its legend.
  if (frame.plan.runs(Pass::BeginPicture)) legend_ = legendOf(frame, maps, study);
  drawLegend(pixels, frame.view.size, legend_, typeface_);
}

}  // namespace sluice::render
