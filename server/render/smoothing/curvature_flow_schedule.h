#pragma once

#include <string>

#include "smoothing/smoothing_method.h"

namespace sluice::render {

/// Largest flow time, m², by which one explicit step of the flow in inverse depth is stable anywhere in the picture:
/// s²/(2σ(W)) with the pixel's footprint s = C·z and σ(W) = √(1+|W|²)·(1+|W|²/2) at view slope W. That is the worst
/// case over all orientations of the surface, at the nearest depth and the picture's steepest slope: a bound from the
/// surface at hand would grow too large as bumps flatten.
double largestStableStep(const SurfaceTraits& traits);

/// As many steps of at most `stepFraction·largestStep` as `wantedTime` needs, `maxIterations` at most.
FlowSchedule scheduleSteps(double wantedTime, double largestStep, double stepFraction, unsigned maxIterations);

/// `steps` steps of RKL2, each of as many stages as its share of `wantedTime` needs for no stage to be longer than
/// `largestStep`, but kMostRklStages at most.
FlowSchedule scheduleLongSteps(double wantedTime, double largestStep, unsigned steps);

/// Says in a plan what `schedule` cuts off, and why.
void reportShortfall(const FlowSchedule& schedule, std::string reason, SmoothingPlan& plan);

}  // namespace sluice::render
