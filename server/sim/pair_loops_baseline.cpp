#define SLUICE_PAIR_LOOPS kPairLoopsBaseline
#define SLUICE_INSTRUCTION_SET "baseline"
#include "pair_loops_impl.h"
