// The numbers in the <plugin> of a game or of trials, each in an element of its own. The check, the reader
// and the editor use these tables.
#pragma once

#include <numbers>
#include <string_view>
#include <variant>

#include "bug_interface/world/description.h"

namespace forage::bug {

/// A number and the member that holds it, whose value in new `Rules` is the default.
template <class Rules>
struct RuleOf {
    std::variant<double Rules::*, int Rules::*> member;
    std::string_view name, label, doc;  ///< of the element; in a form; in hints
    double low, high;
    double unit = 1;  ///< of the form, in that of the element

    bool whole() const { return std::holds_alternative<int Rules::*>(member); }
};

inline constexpr RuleOf<TrialRules> trial_rules[] = {
    {&TrialRules::reach, "reach", "Reach, m", "metres", 0.2, 100},
    {&TrialRules::duration, "duration", "Longest trial, s", "seconds of the world", 1e-3, 1e6},
    {&TrialRules::heading, "heading", "Deviation of headings, °", "radians", 0, 3.2, std::numbers::pi / 180},
};
inline constexpr RuleOf<GameRules> game_rules[] = {
    {&GameRules::duration, "duration", "Duration, s", "seconds of the world", 1e-6, 1e6},
    {&GameRules::stale_after, "stale_after", "Stale after, s", "seconds of the world", 1e-6, 1e6},
    {&GameRules::dissolves_after, "dissolves_after", "Dissolves after, s", "seconds of the world", 1e-6, 1e6},
    {&GameRules::points, "points", "Points", "points for the team", -200, 200},
    {&GameRules::penalty, "penalty", "Points when stale", "points for the team", -200, 200},
    {&GameRules::most, "most", "Most resources", "resources at a time", 1, 200},
};

}  // namespace forage::bug
