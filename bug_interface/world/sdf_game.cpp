#include <algorithm>
#include <cmath>
#include <sstream>

#include <fmt/format.h>

#include "bug_interface/world/sdf_elements.h"

namespace forage::bug {
namespace {

constexpr int most_resources = 200;

}  // namespace

GameRules read_game(SdfSource& in, const sdf::ElementPtr& e) {
    GameRules rules;
    rules.where = in.at(e);  // its children are not in the format: they come as text
    // The library does not say where they stand.
    const std::string& file = rules.where.file->text;
    std::size_t cursor = 0;
    for (int line = 1; line < rules.where.line; ++line) cursor = file.find('\n', cursor) + 1;
    Location place = rules.where;
    const auto next = [&](const std::string& name) {
        const auto found = file.find("<" + name, cursor);
        if (found == std::string::npos) return;
        cursor = found + 1;
        place.line =
            1 + static_cast<int>(std::count(file.begin(), file.begin() + static_cast<long>(found), '\n'));
        place.column = static_cast<int>(found - (file.rfind('\n', found) + 1)) + 1;
    };
    const std::vector<std::string> known = {"duration", "stale_after", "dissolves_after", "points", "penalty",
                                            "most",     "site"};
    for (auto c = e->GetFirstElement(); c; c = c->GetNextElement()) {
        const std::string name = c->GetName(), text = c->Get<std::string>();
        next(name);
        std::istringstream words(text);
        std::vector<double> v;
        for (double number; words >> number;) v.push_back(number);
        const std::size_t wanted = name == "site" ? 3 : 1;
        if (std::find(known.begin(), known.end(), name) == known.end()) {
            in.diagnostics.error(place, fmt::format("<{}> is no rule of a game", name), suggest(name, known));
        } else if (v.size() != wanted || !words.eof()) {
            in.diagnostics.error(
                place, fmt::format("<{}> cannot be '{}'", name, text),
                wanted == 3 ? "a site is x y chance: m, m, and how likely a resource appears in a second"
                            : "a number is expected here");
        } else if (name == "site") {
            if (!(v[2] >= 0 && v[2] <= 1))
                in.diagnostics.error(place, fmt::format("a chance of {} is not from 0 to 1", v[2]));
            rules.sites.push_back({v[0], v[1], v[2]});
        } else if ((name == "points" || name == "penalty" || name == "most") &&
                   !(v[0] == std::floor(v[0]) && std::abs(v[0]) <= most_resources)) {
            in.diagnostics.error(place, fmt::format("<{}> cannot be '{}'", name, text),
                                 fmt::format("a whole number up to {} is expected here", most_resources));
        } else if (name == "points" || name == "penalty") {
            (name == "points" ? rules.points : rules.penalty) = static_cast<int>(v[0]);
        } else if (!(v[0] > 0 && v[0] <= 1e6)) {
            in.diagnostics.error(place, fmt::format("<{}> must be above 0", name));
        } else if (name == "most") {
            rules.most = static_cast<int>(v[0]);
        } else {
            (name == "duration"      ? rules.duration
             : name == "stale_after" ? rules.stale_after
                                     : rules.dissolves_after) = v[0];
        }
    }
    return rules;
}

}  // namespace forage::bug
