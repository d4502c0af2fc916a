// Loops compiled for several generations of processors.
#pragma once

/// A function with this attribute is compiled for plain x86-64, for AVX2 and for AVX-512, and the best
/// version that the processor can run is called. All versions give the same numbers, infinities and zeros to
/// the bit: no multiplication is fused with an addition (-ffp-contract=off), and loops that sum run over many
/// sums at a time, never over the terms of one. A NaN is a NaN in all versions; its sign and payload may
/// differ, as x86 keeps those of the first operand and compilers swap operands. The attribute has no effect
/// on other processors, with other compilers, with GCC before 12, and with sanitizers.
#if defined(__x86_64__) && defined(__GNUC__) && __GNUC__ >= 12 && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define FORAGE_SIMD __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define FORAGE_SIMD
#endif
