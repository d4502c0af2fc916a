#include "tools/forage/score.h"

#include <array>

#include <fmt/format.h>

namespace forage::tool {

std::string team_name(int team) { return team == 0 ? "A" : "B"; }

std::string score_table(const bug::Game& game) {
    std::string out = "  score          team   points   good   bad\n";
    for (int team = 0; team < 2; ++team)
        out += fmt::format("  {:<14} {:<4} {:>8} {:>6} {:>5}\n", "", team_name(team), game.points(team),
                           game.delivered(team, true), game.delivered(team, false));
    if (game.timed())
        out +=
            game.over() ? "  time           over\n" : fmt::format("  time left      {:.0f} s\n", game.left());
    return out;
}

std::string score_csv(const bug::Game& game) {
    std::string out = "seconds,team,resource,points,score_a,score_b\n";
    std::array<int, 2> score{};
    for (const auto& d : game.deliveries()) {
        score[static_cast<std::size_t>(d.team)] += d.points;
        out += fmt::format("{:.3f},{},{},{},{},{}\n", d.time, team_name(d.team), d.good ? "good" : "bad",
                           d.points, score[0], score[1]);
    }
    return out;
}

}  // namespace forage::tool
