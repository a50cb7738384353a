#include <algorithm>
#include <array>
#include <string>

#include "features/features_study.h"
#include "scaling/scaling_study.h"
#include "sluice/core/input_error.h"
#include "sluice/evaluate/study.h"
#include "smoothing/smoothing_study.h"
#include "solvers/solvers_study.h"
#include "speed/speed_study.h"
#include "stability/stability_study.h"

namespace sluice::evaluate {

std::span<const Study> studies() {
  static constexpr std::array kStudies{
      Study{"smoothing", "every smoothing method: error against time, and the tables of van der Laan et al. 2009",
            smoothingParts, runSmoothingStudy},
      Study{"solvers", "every pressure solver on flows whose course is known: error against run time", solverParts,
            runSolversStudy},
      Study{"stability", "cases that are made to break what they test: depth images, cameras, steps beyond their bound",
            stabilityParts, runStabilityStudy},
      Study{"features", "what each feature costs, and leaving it out saves", featureParts, runFeaturesStudy},
      Study{"scaling", "how the time of a frame grows with particles and with pixels", scalingParts, runScalingStudy},
      Study{"speed", "the solver's speed: over particles, over threads, and each stage against what the machine can do",
            speedParts, runSpeedStudy},
  };
  return kStudies;
}

std::vector<Study> findStudies(std::string_view name, std::string_view only) {
  const auto join = [](std::string& text, std::string_view word) {
    text += (text.empty() ? "" : ", ") + std::string(word);
  };
  std::vector<Study> found;
  std::string names;
  std::string parts;
  for (const Study& study : studies()) {
    join(names, study.name);
    if (name != "all" && name != study.name) continue;
    const std::vector<std::string> ofStudy = study.parts();
    for (const std::string& part : ofStudy) join(parts, part);
    if (only.empty() || std::ranges::find(ofStudy, only) != ofStudy.end()) found.push_back(study);
  }
  if (name != "all" && parts.empty()) {
    throw core::InputError("", "STUDY", "\"" + std::string(name) + "\" is not a study; there are: " + names + ", all");
  }
  if (found.empty()) {
    throw core::InputError("", "--only", "\"" + std::string(only) + "\" is no part of it; there are: " + parts);
  }
  return found;
}

}  // namespace sluice::evaluate
