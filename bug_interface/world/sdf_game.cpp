#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "bug_interface/world/sdf_elements.h"
#include "bug_interface/world/sdf_values.h"

namespace forage::bug {
namespace {

constexpr int most_resources = 200;

}  // namespace

GameRules read_game(SdfSource& in, const xml::Element& e) {
    GameRules rules;
    rules.where = e.where;
    const std::vector<std::string> known = {"duration", "stale_after", "dissolves_after", "points", "penalty",
                                            "most",     "site"};
    for (const auto& [name, text, place, text_place, attributes, children] : e.children) {
        const auto [v, wrong] = numbers(text);
        const bool finite = std::all_of(v.begin(), v.end(), [](double x) { return std::isfinite(x); });
        const std::size_t wanted = name == "site" ? 3 : 1;
        if (std::find(known.begin(), known.end(), name) == known.end()) {
            in.diagnostics.error(place, fmt::format("<{}> is no rule of a game", name), suggest(name, known));
        } else if (v.size() != wanted || !wrong.empty() || !finite) {
            in.diagnostics.error(
                place, fmt::format("<{}> cannot be '{}'", name, text),
                wanted == 3 ? "a site is x y chance: m, m, and how likely a resource appears in a second"
                            : "a number is expected here");
        } else if (name == "site") {
            if (!(v[2] >= 0 && v[2] <= 1))
                in.diagnostics.error(place, fmt::format("a chance of {} is not from 0 to 1", v[2]),
                                     "it is that of a resource in each second");
            rules.sites.push_back({v[0], v[1], v[2], place});
        } else if ((name == "points" || name == "penalty" || name == "most") &&
                   !(v[0] == std::floor(v[0]) && std::abs(v[0]) <= most_resources)) {
            in.diagnostics.error(place, fmt::format("<{}> cannot be '{}'", name, text),
                                 fmt::format("a whole number up to {} is expected here", most_resources));
        } else if (name == "points" || name == "penalty") {
            (name == "points" ? rules.points : rules.penalty) = static_cast<int>(v[0]);
        } else if (!(v[0] > 0 && v[0] <= 1e6)) {
            in.diagnostics.error(place, fmt::format("<{}> must be above 0", name),
                                 name == "most" ? "resources at a time" : "seconds of the world");
        } else if (name == "most") {
            rules.most = static_cast<int>(v[0]);
        } else {
            (name == "duration"      ? rules.duration
             : name == "stale_after" ? rules.stale_after
                                     : rules.dissolves_after) = v[0];
        }
    }
    if (rules.stale_after >= rules.dissolves_after)
        in.diagnostics.warning(e.where, "resources dissolve before they turn yellow",
                               fmt::format("<stale_after> is {:g} s, <dissolves_after> {:g} s",
                                           rules.stale_after, rules.dissolves_after));
    return rules;
}

}  // namespace forage::bug
