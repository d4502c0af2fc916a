// Structs of numbers that authors of types declare: the states of a cell, the states of a synapse, and what a
// synapse reads from its target.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <type_traits>

#include "core/types/type_error.h"

namespace forage::detail {

/// Stands for a struct that a type does not have.
struct NoNumbers {};

template <class S>
inline constexpr std::size_t numbers_in = std::is_empty_v<S> ? 0 : sizeof(S) / sizeof(double);

/// The i-th number of a struct.
template <std::size_t i, class S>
[[gnu::always_inline]] inline double& number(S& s) {
    return *reinterpret_cast<double*>(reinterpret_cast<std::byte*>(&s) + i * sizeof(double));
}

/// A copy of a type's object, which loops over columns keep in registers. For a type with texts it is a
/// reference to the object.
template <class T>
using Own = std::conditional_t<std::is_trivially_copyable_v<T>, T, const T&>;

/// Refuses a member of a type's struct that is not a number.
template <class M>
constexpr void require_double() {
    static_assert(std::is_same_v<M, double>, "a state is a double");
}

/// Maps each number of S to the declaration that stands for it.
template <class S>
class NumberMap {
    static_assert(
        std::is_trivially_copyable_v<S> && std::is_standard_layout_v<S>,
        "the struct of a type's states, or of what it reads of its target, has members of type double only");

  public:
    /// `name` is the name of the struct in messages.
    explicit NumberMap(const char* name) : name_(name) { index_.fill(undeclared); }
    /// Throws TypeError when the member is declared already.
    void declare(double S::*member, std::size_t index) {
        const S s{};
        const auto offset = reinterpret_cast<const char*>(&(s.*member)) - reinterpret_cast<const char*>(&s);
        auto& place = index_[static_cast<std::size_t>(offset) / sizeof(double)];
        if (place != undeclared) throw TypeError("describe() declares a number of its " + name_ + " twice");
        place = index;
    }
    /// The index of the declaration of each number. Throws TypeError when one is not declared.
    const std::array<std::size_t, numbers_in<S>>& indices() const {
        if (std::count(index_.begin(), index_.end(), undeclared) > 0)
            throw TypeError("its " + name_ + " holds a number that describe() does not declare");
        return index_;
    }

  private:
    static constexpr std::size_t undeclared = -1;
    std::string name_;
    std::array<std::size_t, numbers_in<S>> index_;
};

}  // namespace forage::detail
