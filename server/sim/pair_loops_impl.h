// The loops over pairs, for the instruction set that the including unit is compiled for. Such a unit defines
// SLUICE_PAIR_LOOPS, the name of its table, and SLUICE_INSTRUCTION_SET, the name people see.

#include "pressure_loops.h"
#include "search_loops.h"
#include "spin_loops.h"
#include "tension_loops.h"
#include "viscosity_loops.h"

namespace sluice::sim {

extern const PairLoops SLUICE_PAIR_LOOPS;
const PairLoops SLUICE_PAIR_LOOPS{
    .instructionSet = SLUICE_INSTRUCTION_SET,
    .findNeighbours = findNeighbours,
    .addBoundary = addBoundary,
    .weighBoundary = weighBoundary,
    .weighSquares = weighSquares,
    .applyImpulses = applyImpulses,
    .relaxImpulses = relaxImpulses,
    .densityRate = densityRate,
    .diffuse = diffuse,
    .weightedGradient = weightedGradient,
    .applyViscosity = applyViscosity,
    .viscosityBlocks = viscosityBlocks,
    .cohere = cohere,
    .exchangeSpin = exchangeSpin,
};

}  // namespace sluice::sim
