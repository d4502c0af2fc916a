// Whether a type has members that it has not declared as parameters.
#pragma once

#include <algorithm>
#include <type_traits>
#include <vector>

#include "core/base/member_count.h"
#include "core/types/parameter.h"

namespace forage {

/// Whether T has no members beside `parameters`, so that nothing else needs to be saved. Returns false for a
/// type with a constructor or private members, whose members cannot be counted; such a type declares what is
/// saved.
template <class T>
bool only_parameters(std::vector<Parameter> parameters) {
    if constexpr (std::is_empty_v<T>) return true;
    if constexpr (std::is_aggregate_v<T>) {
        if (member_count<T>() > parameters.size()) return false;
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
