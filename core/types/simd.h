// Loops compiled for several generations of processors.
#pragma once

/// Before a function: it is compiled for plain x86-64, for AVX2 and for AVX-512, and the best one that the
/// processor can run is called. All give the same bits: no multiplication is fused with an addition
/// (-ffp-contract=off), and loops that sum run over many sums at a time, never over the terms of one. Without
/// effect with other processors and compilers, and with sanitizers, which cannot follow the choice at load
/// time.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define FORAGE_SIMD __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define FORAGE_SIMD
#endif
