#include <algorithm>

#include "legend_layout.h"
#include "planner.h"

namespace sluice::render {

std::size_t Planner::coloursToExplain() const {
  const v1::View& view = scene_.view();
  if (view.has_noise()) return plan_.runs(Pass::Noise) ? 1 : 0;
  if (showsValues(view)) return plan_.runs(Pass::Study) || plan_.runs(Pass::StudyFoam) ? 1 : 0;
  std::size_t maps = 0;
  for (std::size_t k = 0; k < liquids_.size(); ++k) {
    if (plan_.runs(Pass::ColourMap, k)) ++maps;
  }
  return maps;
}

void Planner::planLegend() {
  if (reuse_.picture && !reuse_.legend) return leaveOut(Pass::Legend, "the last frame had none");
  if (!reuse_.picture) {
    const std::size_t colours = coloursToExplain();
    if (!scene_.view().legend()) return leaveOut(Pass::Legend, "view.legend is off");
    if (colours == 0) return leaveOut(Pass::Legend, "no colour stands for a value");
    if (!legendFits(size_, colours)) return leaveOut(Pass::Legend, "the picture is too small to hold it");
  }
  run(Pass::Legend, {Resource::Screen}, {Resource::Screen});
}

}  // namespace sluice::render
