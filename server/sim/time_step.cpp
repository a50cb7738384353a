#include "time_step.h"

#include <cmath>

namespace sluice::sim {

TimeStepChoice chooseTimeStep(const v1::TimeStep& settings, const TimeStepInputs& inputs) {
  TimeStepChoice choice{settings.max_seconds(), "max_seconds"};
  const auto bound = [&](double seconds, std::string_view limit) {
    if (seconds < choice.seconds) choice = {seconds, limit};
  };
  const double smoothingLength = inputs.support / 2;

  if (inputs.maxSpeed > 0) bound(settings.cfl() * inputs.spacing / inputs.maxSpeed, "cfl");
  // Force and viscous bounds of explicit SPH, Monaghan 1992 and Morris et al. 1997.
  if (inputs.gravity > 0) bound(0.25 * std::sqrt(smoothingLength / inputs.gravity), "gravity");
  if (inputs.viscosity > 0) bound(0.125 * smoothingLength * smoothingLength / inputs.viscosity, "viscosity");
  bound(inputs.recovery, "recovery");
  return choice;
}

}  // namespace sluice::sim
