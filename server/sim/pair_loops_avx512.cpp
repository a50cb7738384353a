#define SLUICE_PAIR_LOOPS kPairLoopsAvx512
#define SLUICE_INSTRUCTION_SET "AVX-512"
#include "pair_loops_impl.h"
