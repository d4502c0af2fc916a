// Four numbers side by side, for loops that compilers do not vectorise by themselves.
#pragma once

#include <cmath>
#include <cstring>

namespace forage::bug {

// All functions with vectors are inlined, so it does not matter how a processor without AVX would pass these.
#pragma GCC diagnostic ignored "-Wpsabi"

typedef double Four __attribute__((vector_size(4 * sizeof(double))));  // NOLINT: no `using` for these

/// Four times the same number.
[[gnu::always_inline]] inline Four four(double v) { return v - Four{}; }

/// The four numbers from `at` on.
[[gnu::always_inline]] inline Four load(const double* at) {
    Four out;
    std::memcpy(&out, at, sizeof out);
    return out;
}
[[gnu::always_inline]] inline Four load(const float* at) {
    const double numbers[] = {at[0], at[1], at[2], at[3]};
    return load(numbers);
}
[[gnu::always_inline]] inline void store(const Four& v, double* at) { std::memcpy(at, &v, sizeof v); }

/// Rounds to single precision. Conversions in a loop would not do: GCC 12 leaves them out.
[[gnu::always_inline]] inline Four rounded_to_single(const Four& v) {
    typedef float Single __attribute__((vector_size(4 * sizeof(float))));  // NOLINT
    const Single single = __builtin_convertvector(v, Single);
    float numbers[4];
    std::memcpy(numbers, &single, sizeof numbers);
    return load(numbers);
}
[[gnu::always_inline]] inline Four magnitude(const Four& v) { return v < 0 ? -v : v; }
[[gnu::always_inline]] inline Four square_root(const Four& v) {
    double roots[4];
    store(v, roots);
    for (double& r : roots) r = std::sqrt(r);
    return load(roots);
}

}  // namespace forage::bug
