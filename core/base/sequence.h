// What is done with the elements of containers everywhere.
#pragma once

#include <algorithm>
#include <functional>
#include <iterator>
#include <string>
#include <type_traits>
#include <vector>

namespace forage {

/// The results of `f`, a function or a member, for each element.
template <class Elements, class F>
auto collected(const Elements& all, F f) {
    std::vector<std::decay_t<std::invoke_result_t<F&, decltype(*std::begin(all))>>> out;
    for (const auto& each : all) out.push_back(std::invoke(f, each));
    return out;
}

/// The names of all elements.
template <class Elements>
std::vector<std::string> names_of(const Elements& all) {
    return collected(all, [](const auto& each) { return std::string(each.name); });
}

/// Whether an element, or `part` of it, which is a function or a member, is `value`.
template <class Elements, class Value, class Part = std::identity>
bool contains(const Elements& all, const Value& value, Part part = {}) {
    return std::ranges::find(all, value, part) != std::ranges::end(all);
}

/// The first element of which `part` is `value`; null when there is none.
template <class Elements, class Value, class Part>
auto find_by(Elements& all, const Value& value, Part part) -> decltype(&*std::ranges::begin(all)) {
    const auto it = std::ranges::find(all, value, part);
    return it == std::ranges::end(all) ? nullptr : &*it;
}

}  // namespace forage
