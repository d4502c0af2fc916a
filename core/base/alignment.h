// The difference of two sequences.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace forage {

/// Pairs of places of equal elements in two sequences, in order: a longest common subsequence. An element of
/// only one sequence is paired with -1. Very different sequences are not compared in the middle.
template <class T>
std::vector<std::pair<int, int>> aligned(const std::vector<T>& a, const std::vector<T>& b) {
    std::size_t front = 0, back = 0;
    while (front < std::min(a.size(), b.size()) && a[front] == b[front]) ++front;
    while (back < std::min(a.size(), b.size()) - front && a[a.size() - 1 - back] == b[b.size() - 1 - back])
        ++back;
    const std::size_t n = a.size() - front - back, m = b.size() - front - back;
    std::vector<std::pair<int, int>> out;
    const auto add = [&](std::size_t i, std::size_t j) {
        out.emplace_back(static_cast<int>(i), static_cast<int>(j));
    };
    for (std::size_t i = 0; i < front; ++i) add(i, i);
    constexpr std::size_t most = 4'000'000;  // pairs that are compared
    constexpr auto none = static_cast<std::size_t>(-1);
    std::size_t i = 0, j = 0;
    if (n > 0 && m > 0 && n * m <= most) {
        std::vector<std::uint32_t> longest((n + 1) * (m + 1));  // of what begins at i and j
        const auto at = [&](std::size_t x, std::size_t y) -> std::uint32_t& {
            return longest[x * (m + 1) + y];
        };
        for (std::size_t x = n; x-- > 0;)
            for (std::size_t y = m; y-- > 0;)
                at(x, y) = a[front + x] == b[front + y] ? at(x + 1, y + 1) + 1
                                                        : std::max(at(x + 1, y), at(x, y + 1));
        while (i < n && j < m)
            if (a[front + i] == b[front + j])
                add(front + i, front + j), ++i, ++j;
            else if (at(i + 1, j) >= at(i, j + 1))
                add(front + i++, none);
            else
                add(none, front + j++);
    }
    for (; i < n; ++i) add(front + i, none);
    for (; j < m; ++j) add(none, front + j);
    for (std::size_t k = back; k-- > 0;) add(a.size() - 1 - k, b.size() - 1 - k);
    return out;
}

}  // namespace forage
