#include "smoothing/smoothing_method.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sluice/core/check.h"

namespace sluice::render {

std::span<const SmoothingMethodEntry> smoothingMethods() {
  static constexpr std::array kMethods{
      SmoothingMethodEntry{v1::Smoothing::kImplicitCurvatureFlow, planImplicitCurvatureFlow, makeImplicitCurvatureFlow},
      SmoothingMethodEntry{v1::Smoothing::kCurvatureFlow, planCurvatureFlow, makeCurvatureFlow},
      SmoothingMethodEntry{v1::Smoothing::kRklCurvatureFlow, planRklCurvatureFlow, makeRklCurvatureFlow},
      SmoothingMethodEntry{v1::Smoothing::kCurvatureFlowVanderlaan2009, planCurvatureFlowVanDerLaan2009,
                           makeCurvatureFlowVanDerLaan2009},
      SmoothingMethodEntry{v1::Smoothing::kNarrowRange, planNarrowRange, makeNarrowRange},
      SmoothingMethodEntry{v1::Smoothing::kPlaneFit, planPlaneFit, makePlaneFit},
      SmoothingMethodEntry{v1::Smoothing::kBilateral, planBilateral, makeBilateral},
      SmoothingMethodEntry{v1::Smoothing::kFullBilateral, planFullBilateral, makeFullBilateral},
      SmoothingMethodEntry{v1::Smoothing::kGaussian, planGaussian, makeGaussian},
      SmoothingMethodEntry{v1::Smoothing::kBinomial, planBinomial, makeBinomial},
  };
  return kMethods;
}

const SmoothingMethodEntry* findSmoothingMethod(v1::Smoothing::MethodCase method) {
  const std::span<const SmoothingMethodEntry> methods = smoothingMethods();
  const auto found = std::ranges::find(methods, method, &SmoothingMethodEntry::method);
  return found == methods.end() ? nullptr : &*found;
}

std::string smoothingName(v1::Smoothing::MethodCase method) {
  const auto* const field = v1::Smoothing::descriptor()->FindFieldByNumber(static_cast<int>(method));
  SLUICE_CHECK(field != nullptr);
  std::string name = field->name();
  std::ranges::replace(name, '_', ' ');
  return name;
}

double smoothingDeviation(const v1::Smoothing& smoothing, double spacing) {
  return std::sqrt(smoothing.time()) * spacing;
}

}  // namespace sluice::render
