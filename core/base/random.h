// Random numbers that depend only on their use.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace forage {

/// A counter-based random stream (Philox4x32-10; Salmon et al., "Parallel random numbers: as easy as 1, 2,
/// 3", SC 2011). A number is a function of (seed, item, stream, cycle, index, draw): it does not depend on
/// what was drawn before, on the number of threads, or on other items of the system. `draw` separates
/// several numbers for one index in one cycle; it is below 2^30. normal() and bits() use the same blocks as
/// draw 0 of uniform(), so a stream must provide only one of these three in a cycle.
class RandomStream {
  public:
    RandomStream() = default;
    /// `item` is the id of a group, connection or robot; `stream` separates several uses by one item.
    RandomStream(std::uint64_t seed, std::string_view item, std::uint32_t stream = 0);

    /// Returns a number that is uniform in [0, 1), with 53 random bits.
    double uniform(std::uint64_t cycle, std::uint32_t index, std::uint32_t draw = 0) const;
    /// Sets out[i] = uniform(cycle, first + i, draw), faster than separate calls. `first` is a multiple of
    /// `grain`.
    void uniform(std::uint64_t cycle, std::span<double> out, std::uint32_t draw = 0,
                 std::size_t first = 0) const;
    /// Sets out[i] = `value` with this `probability` (exact to 53 bits; NaN: never), else 0. This is many
    /// times faster than a comparison of uniform numbers, and independent of them. `out` is the part of a
    /// column that begins at `first`, a multiple of `grain`.
    void events(std::uint64_t cycle, double probability, std::span<double> out, double value = 1,
                std::uint32_t draw = 0, std::size_t first = 0) const;
    /// A column may be computed in parts whose sizes are multiples of this.
    static constexpr std::size_t grain = 64;
    /// Fills `out` with standard normal numbers (mean 0, variance 1; Box-Muller transform of uniform
    /// numbers).
    void normal(std::uint64_t cycle, std::span<double> out) const;
    /// Fills `out` with uniform 64-bit words.
    void bits(std::uint64_t cycle, std::span<std::uint64_t> out) const;

  private:
    std::uint64_t key_ = 0;
};

}  // namespace forage
