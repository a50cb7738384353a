#include "time_step.h"

#include <cmath>
#include <numbers>

namespace sluice::sim {

namespace {

// Explicit viscosity is stable in steps of up to this times h²/ν. Morris et al. 1997 give 1/8; with the factor 2(D+2)
// of the form used here, viscous fluid was seen to burst there, and a continuum bounds the fastest decay by 20 ν/h²
// (cubic spline, three dimensions), which allows 2/20.
constexpr double kViscousNumber = 0.1;

}  // namespace

ViscosityChoice viscosityChoiceOf(const v1::Simulation& simulation) {
  if (simulation.has_explicit_viscosity()) return ViscosityChoice::Explicit;
  if (simulation.has_implicit_viscosity()) return ViscosityChoice::Implicit;
  return ViscosityChoice::Automatic;
}

TimeStepChoice chooseTimeStep(const v1::TimeStep& settings, const TimeStepInputs& inputs) {
  TimeStepChoice choice{settings.max_seconds(), "max_seconds", false};
  const auto bound = [&](double seconds, std::string_view limit) {
    if (seconds < choice.seconds) choice = {seconds, limit, false};
  };
  const double smoothingLength = inputs.support / 2;

  if (inputs.maxSpeed > 0) bound(settings.cfl() * inputs.spacing / inputs.maxSpeed, "cfl");
  // Monaghan 1992.
  if (inputs.acceleration > 0) bound(0.25 * std::sqrt(smoothingLength / inputs.acceleration), "force");
  // Capillary waves of the shortest length must not cross a smoothing length in one step, Brackbill et al. 1992.
  // Adhesion, which is on the scale of tension, as stiff as that.
  const double cube = smoothingLength * smoothingLength * smoothingLength;
  const auto boundCapillary = [&](double kinematicTension, std::string_view limit) {
    if (kinematicTension > 0) bound(0.25 * std::sqrt(cube / (2 * std::numbers::pi * kinematicTension)), limit);
  };
  boundCapillary(inputs.kinematicTension, "surface tension");
  boundCapillary(inputs.kinematicAdhesion, "adhesion");
  if (inputs.speedOfSound > 0) {
    bound(inputs.courant * smoothingLength / (inputs.speedOfSound + inputs.maxSpeed), "sound");
  }
  bound(inputs.recovery, "recovery");

  if (inputs.viscosity > 0) {
    const double stable = kViscousNumber * smoothingLength * smoothingLength / inputs.viscosity;
    switch (inputs.viscosityChoice) {
      case ViscosityChoice::Automatic:
        choice.implicitViscosity = choice.seconds > stable;
        break;
      case ViscosityChoice::Explicit:
        bound(stable, "viscosity");
        break;
      case ViscosityChoice::Implicit:
        choice.implicitViscosity = true;
        break;
    }
  }
  return choice;
}

}  // namespace sluice::sim
