#pragma once

#include <vector>

#include "sluice/evaluate/report.h"
#include "sluice/evaluate/study.h"
#include "sluice/render/fluid_renderer.h"

namespace sluice::evaluate {

/// Every smoothing method on the hard depth images and cameras; implicit ones up to T = 10⁴ d²;
/// and explicit ones for 10,000 steps on noise, just within and just beyond their bound. Every case tells its outcome.
std::vector<Row> smoothingStability(const Options& options);

/// How a picture of inverse depths came out of smoothing.
struct Outcome {
  std::string text;    ///< "bounded", or what went wrong.
  double largest = 1;  ///< Largest factor by which a value leaves the range of those before.
  bool passed = false;
};

/// The range may be left by this factor: the flow has no new extremes, but its differences have at silhouettes.
constexpr double kRangeFactor = 2;

/// Where a method may draw: nowhere that there was no liquid before, or in the gaps between its splats too.
enum class LiquidMay { Shrink, FillGaps };

Outcome judgeSmoothed(const render::FloatPicture& before, const render::FloatPicture& after,
                      LiquidMay may = LiquidMay::Shrink);

}  // namespace sluice::evaluate
