#pragma once

#include <vector>

#include "container.h"
#include "particles.h"

namespace sluice::sim {

/// Points of the faces of a container that is no plain box, about a spacing apart, and of layers - 1 shells behind
/// them, without those that no particle inside can feel.
std::vector<Float4> sampleEnclosure(const Container& container, double spacing, double support, int layers);

/// About how many these are, before any are made.
double expectedEnclosureSamples(const solids::Enclosure& enclosure, double spacing, int layers);

}  // namespace sluice::sim
