// The rules of games and trials.
#include <fmt/format.h>

#include "bug_interface/world/sdf_elements.h"
#include "bug_interface/world/sdf_rules.h"
#include "core/xml/check.h"

namespace forage::bug {
namespace {

using xml::ValueKind;

template <class Rules>
xml::Format rules_format(std::string_view name, const auto& table) {
    xml::Format out{.name = name, .beginning = "<plugin ...>", .roots = {"plugin"}};
    auto& plugin = out.elements.emplace_back();
    plugin.name = "plugin", plugin.attributes = {xml::text("name", ""), xml::text("filename", "")};
    for (const RuleOf<Rules>& rule : table) {
        out.values[std::string(rule.name)] = {.kind = rule.whole() ? ValueKind::whole : ValueKind::number,
                                              .doc = std::string(rule.doc),
                                              .low = rule.low,
                                              .high = rule.high};
        plugin.content += fmt::format("{0}?:{0} ", rule.name);
    }
    return out;
}

/// Reads the numbers of rules that have no mistakes. Returns whether there are none.
template <class Rules>
bool read_rules(SdfSource& in, const xml::Element& e, const xml::Format& format, const auto& table,
                Rules& rules) {
    rules.where = e.where();
    const int errors_before = in.diagnostics.errors();
    xml::check(e, *format.find("plugin"), format, in.diagnostics);
    if (in.diagnostics.errors() > errors_before) return false;
    for (const RuleOf<Rules>& rule : table)
        if (const auto value = e.value(rule.name).number())
            std::visit([&]<class T>(T Rules::*member) { rules.*member = static_cast<T>(*value); },
                       rule.member);
    return true;
}

}  // namespace

GameRules read_game(SdfSource& in, const xml::Element& e) {
    static const xml::Format format = [] {
        auto out = rules_format<GameRules>("a game", game_rules);
        out.values["site"] = {.kind = ValueKind::number,
                              .doc = "x and y in m, and how likely a resource appears in a second",
                              .least = 3,
                              .most = 3};
        out.elements.front().content += "site:site";
        return std::move(out).link();
    }();
    GameRules rules;
    if (!read_rules(in, e, format, game_rules, rules)) return rules;
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
    static const xml::Format format = rules_format<TrialRules>("trials", trial_rules).link();
    TrialRules rules;
    read_rules(in, e, format, trial_rules, rules);
    return rules;
}

}  // namespace forage::bug
