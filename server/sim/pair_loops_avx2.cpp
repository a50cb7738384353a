#define SLUICE_PAIR_LOOPS kPairLoopsAvx2
#define SLUICE_INSTRUCTION_SET "AVX2"
#include "pair_loops_impl.h"
