// The score of a game, for people and for tables.
#pragma once

#include <string>

#include "bug_interface/simulation/game.h"

namespace forage::tool {

/// "A" or "B".
std::string team_name(int team);

/// Points of both teams and what they delivered, as lines of a summary.
std::string score_table(const bug::Game& game);

/// seconds,team,resource,points,score_a,score_b: a row per delivery.
std::string score_csv(const bug::Game& game);

}  // namespace forage::tool
