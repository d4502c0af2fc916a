#include "core/model/world_change.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/base/number.h"
#include "core/model/lookup.h"

namespace forage::expression {
namespace {

constexpr const char* move_hint =
    "for example 'move Bug=0.5,-0.5' (m), or with a heading 'move Bug=0.5,-0.5,1.57' (rad)";

/// Where a part of a text begins in it.
std::size_t place_in(std::string_view whole, std::string_view part) {
    return static_cast<std::size_t>(part.data() - whole.data());
}

Move read_move(std::string_view whole, std::string_view rest) {
    const auto equals = std::min(rest.rfind('='), rest.size());
    const auto name = model::trim(rest.substr(0, equals));
    std::vector<double> numbers;
    for (auto at = equals; at < rest.size();) {
        const auto end = std::min(rest.find(',', at + 1), rest.size());
        const auto word = model::trim(rest.substr(at + 1, end - at - 1));
        const auto number = parse_number<double>(word);
        if (!number || !std::isfinite(*number))
            throw Mistake(place_in(whole, word.empty() ? rest.substr(at) : word),
                          fmt::format("'{}' is not a number", word), move_hint);
        numbers.push_back(*number);
        at = end;
    }
    if (name.empty() || numbers.size() < 2 || numbers.size() > 3)
        throw Mistake(0, "a move has a name and a place", move_hint);
    return {{std::string(name), place_in(whole, name)},
            numbers[0],
            numbers[1],
            numbers.size() == 3 ? std::optional(numbers[2]) : std::nullopt};
}

NewTrial read_trial(std::string_view whole, std::string_view rest) {
    const auto equals = rest.rfind('=');
    const auto name = model::trim(rest.substr(0, equals));
    NewTrial out{{std::string(name), name.empty() ? 0 : place_in(whole, name)}, {}};
    if (equals == rest.npos) return out;
    const auto word = model::trim(rest.substr(equals + 1));
    out.start = parse_number<std::size_t>(word);
    if (!out.start)
        throw Mistake(place_in(whole, rest) + equals + 1,
                      fmt::format("'{}' is not the number of a start pose", word), "they are counted from 0");
    return out;
}

}  // namespace

std::optional<WorldChange> parse_world_change(std::string_view text) {
    const auto words = model::trim(text);
    const auto verb = words.substr(0, words.find(' '));
    const auto rest = words.substr(verb.size());
    if (verb == "move") return read_move(text, rest);
    if (verb == "begin_trial") return read_trial(text, rest);
    return std::nullopt;
}

}  // namespace forage::expression
