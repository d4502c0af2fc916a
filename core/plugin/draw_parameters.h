// Random parameters for the tests of a plugin's types.
#pragma once

#include <string>

#include <fmt/format.h>

#include "core/base/random.h"
#include "core/types/parameter.h"

namespace forage::plugin {

/// Sets those parameters of an object that have a range to random values within it. Returns them as text: ",
/// with rate = 0.3".
template <class Type>
std::string draw_parameters(const Type& type, void* object, const RandomStream& random, std::uint64_t draw) {
    std::string out;
    for (std::uint32_t i = 0; i < type.parameters.size(); ++i) {
        const Parameter& p = type.parameters[i];
        if (!p.range || p.at_start) continue;
        const double value = p.range->low + random.uniform(draw, i) * (p.range->high - p.range->low);
        p.set(object, p.kind == ParameterKind::real ? ParameterValue(value) : static_cast<int>(value));
        out += fmt::format("{}{} = {}", out.empty() ? ", with " : ", ", p.name, to_text(p.get(object)));
    }
    return out;
}

}  // namespace forage::plugin
