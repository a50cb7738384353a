#pragma once

#include <limits>
#include <string_view>

#include "sluice/v1/scene.pb.h"

namespace sluice::sim {

/// How the scene wants viscosity to be treated.
enum class ViscosityChoice { Automatic, Explicit, Implicit };

ViscosityChoice viscosityChoiceOf(const v1::Simulation& simulation);

/// What bounds the length of the next step.
struct TimeStepInputs {
  double spacing = 0;            ///< d, m.
  double support = 0;            ///< H, m.
  double maxSpeed = 0;           ///< max |v|, m/s.
  double acceleration = 0;       ///< Largest of gravity and explicit pressure forces, m/s².
  double viscosity = 0;          ///< ν, m²/s; 0 where no viscosity stage runs.
  double kinematicTension = 0;   ///< σ/ρ0 of the lightest fluid, m³/s²; 0 where there is no surface tension.
  double kinematicAdhesion = 0;  ///< Likewise of the strongest adhesion to a wall or body.
  double speedOfSound = 0;       ///< c0, m/s; 0 where pressure acts at once.
  double courant = 0.25;         ///< Smoothing lengths that sound may cross.
  ViscosityChoice viscosityChoice = ViscosityChoice::Automatic;
  /// Bound left by a step that had to be taken back, s.
  double recovery = std::numeric_limits<double>::infinity();
};

struct TimeStepChoice {
  double seconds = 0;
  /// "max_seconds", "cfl", "force", "surface tension", "adhesion", "sound", "recovery" or "viscosity".
  std::string_view limit;
  bool implicitViscosity = false;
};

/// The smallest of the bounds that apply; `min_seconds` is for the caller to hold against it.
TimeStepChoice chooseTimeStep(const v1::TimeStep& settings, const TimeStepInputs& inputs);

}  // namespace sluice::sim
