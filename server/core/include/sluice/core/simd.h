#pragma once

// Compiles a function for several instruction sets and picks the best at run time. Our targets forbid the compiler to
// fuse multiply-adds, so that every version gives the same bits.
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define SLUICE_SIMD_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define SLUICE_SIMD_CLONES
#endif
