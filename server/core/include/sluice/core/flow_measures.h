#pragma once

namespace sluice::core {

/// What tells of the error of a flow as a whole. It costs a pass over all particles and their pairs, so it is taken
/// when somebody asks and not with every step.
struct FlowMeasures {
  double meanDivergence = 0;   ///< Mean of |Dρ/Dt|/ρ over the particles, 1/s.
  double maxDivergence = 0;    ///< Its largest value, 1/s.
  double kineticEnergy = 0;    ///< J.
  double potentialEnergy = 0;  ///< Against gravity, from the scene's origin, J.
  /// Momentum that came from nowhere in the steps in which nothing but gravity acted from outside (no wall, body,
  /// nozzle, drain or hand in reach), over the sum of m·|v|: what the methods and rounding make of momentum. 0 without
  /// such steps.
  double momentumDrift = 0;
};

}  // namespace sluice::core
