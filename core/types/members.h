// Whether a type has members that it has not declared as parameters.
#pragma once

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/types/parameter.h"

namespace forage {
namespace detail {

struct Anything {
    template <class T>
    operator T() const;  // NOLINT: a value for a member of any type
};
template <std::size_t>
using AnythingFor = Anything;

template <class T, std::size_t... I>
constexpr bool takes(std::index_sequence<I...>) {
    return requires { T{AnythingFor<I>{}...}; };
}
/// The number of values that an aggregate can be initialised with, one per member.
template <class T, std::size_t N = 0>
constexpr std::size_t members() {
    if constexpr (takes<T>(std::make_index_sequence<N + 1>()))
        return members<T, N + 1>();
    else
        return N;
}

}  // namespace detail

/// Whether T has no members beside `parameters`, so that nothing else needs to be saved. Returns false for a
/// type with a constructor or private members, whose members cannot be counted; such a type declares what is
/// saved.
template <class T>
bool only_parameters(std::vector<Parameter> parameters) {
    if constexpr (std::is_empty_v<T>) return true;
    if constexpr (std::is_aggregate_v<T>) {
        if (detail::members<T>() > parameters.size()) return false;
        // Between the parameters there may be only gaps of alignment. Larger gaps may hold members that
        // cannot be initialised.
        std::sort(parameters.begin(), parameters.end(),
                  [](const auto& a, const auto& b) { return a.offset < b.offset; });
        std::size_t end = 0;
        for (const auto& p : parameters) {
            if (p.offset >= end + std::min(p.size, alignof(double))) return false;
            end = p.offset + p.size;
        }
        return sizeof(T) < end + alignof(T);
    }
    return false;
}

}  // namespace forage
