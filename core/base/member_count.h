// The number of members of a struct, so that a list of them is checked when it is compiled.
#pragma once

#include <cstddef>
#include <utility>

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

}  // namespace detail

/// The number of values that an aggregate can be initialised with: one per member, and one for a base.
template <class T, std::size_t N = 0>
constexpr std::size_t member_count() {
    if constexpr (detail::takes<T>(std::make_index_sequence<N + 1>()))
        return member_count<T, N + 1>();
    else
        return N;
}

}  // namespace forage
