#include <fmt/format.h>

#include "bug_interface/world/sdf_elements.h"
#include "bug_interface/world/sdf_format.h"
#include "core/xml/check.h"

namespace forage::bug {

GameRules read_game(SdfSource& in, const xml::Element& e) {
    GameRules rules;
    rules.where = e.where();
    const int errors_before = in.diagnostics.errors();
    xml::check(e, *game_format().find("plugin"), game_format(), in.diagnostics);
    if (in.diagnostics.errors() > errors_before) return rules;
    rules.duration = e.value("duration").number(rules.duration);
    rules.stale_after = e.value("stale_after").number(rules.stale_after);
    rules.dissolves_after = e.value("dissolves_after").number(rules.dissolves_after);
    rules.points = e.value("points").whole(rules.points);
    rules.penalty = e.value("penalty").whole(rules.penalty);
    rules.most = e.value("most").whole(rules.most);
    for (const xml::Element& site : e.children("site")) {
        const auto v = site.value().numbers();
        if (!(v[2] >= 0 && v[2] <= 1))
            in.diagnostics.error(site.where(), fmt::format("a chance of {} is not from 0 to 1", v[2]),
                                 "it is that of a resource in each second");
        rules.sites.push_back({v[0], v[1], v[2], site.where()});
    }
    if (rules.stale_after >= rules.dissolves_after)
        in.diagnostics.warning(e.where(), "resources dissolve before they turn yellow",
                               fmt::format("<stale_after> is {:g} s, <dissolves_after> {:g} s",
                                           rules.stale_after, rules.dissolves_after));
    return rules;
}

TrialRules read_trials(SdfSource& in, const xml::Element& e) {
    TrialRules rules;
    rules.where = e.where();
    const int errors_before = in.diagnostics.errors();
    xml::check(e, *trials_format().find("plugin"), trials_format(), in.diagnostics);
    if (in.diagnostics.errors() > errors_before) return rules;
    rules.reach = e.value("reach").number(rules.reach);
    rules.duration = e.value("duration").number(rules.duration);
    rules.heading = e.value("heading").number(rules.heading);
    return rules;
}

}  // namespace forage::bug
