// Two teams that collect resources: the robotics challenge's game, its score and its clock.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bug_interface/motion/physics.h"
#include "bug_interface/world/description.h"
#include "core/base/random.h"

namespace forage::bug {

/// A resource that has been brought home.
struct Delivery {
    double time = 0;  ///< s of the world
    int team = 0;     ///< 0: A, 1: B
    bool good = true;
    int points = 0;
    void checkpoint(Archive& archive) { archive(time, team, good, points); }
};

/// Resources are loose things with the target plugin. In every 101st substep each one is looked at: at a home
/// (its middle within 3 m) it counts for that team, at both homes for B, and goes back to where it came from;
/// with more than 100 contacts with robots since the last look it is held.
///
/// With rules there is a clock, and once a second every resource that nobody holds grows older, turns bad
/// (yellow), dissolves, and new good ones (blue) appear at the sites. Resources that are not in the game are
/// away, where the original hid them in the central pillar; so are all when the time is over.
class Game {
  public:
    struct Resource {
        std::size_t body = 0;  ///< its number among the bodies
        Pose2 start;            ///< where it goes back to
        bool away = false, good = true, held = false;
        int age = 0;       ///< s
        int contacts = 0;  ///< since the last look
        void checkpoint(Archive& archive) { archive(start, away, good, held, age, contacts); }
    };

    Game() = default;
    /// `homes`: of team A and B, m. `rules`: none for a world whose resources only go home.
    Game(std::optional<GameRules> rules, std::array<Pose2, 2> homes, std::vector<Resource> resources,
         std::uint64_t seed);

    /// Takes all resources away, where rules let them appear. Before the first substep.
    void begin(Physics& physics);
    /// After each substep; `time`: s of the world, `step`: duration of a substep, s.
    void substep(Physics& physics, double time, double step);

    bool empty() const { return resources_.empty(); }
    bool timed() const { return rules_.has_value(); }
    bool over() const { return rules_ && left() == 0; }
    double left() const;  ///< s
    const std::vector<Resource>& resources() const { return resources_; }
    const std::vector<Delivery>& deliveries() const { return deliveries_; }
    const std::array<Pose2, 2>& homes() const { return homes_; }
    /// "A" or "B".
    static std::string team_name(int team) { return team == 0 ? "A" : "B"; }
    int points(int team) const;
    int delivered(int team, bool good) const;

    void checkpoint(Archive& archive) {
        archive(resources_, deliveries_, since_look_, seconds_, to_next_second_, count_);
    }

    static constexpr double home_radius = 3;  ///< m

  private:
    void look(Physics& physics, double time);
    void second(Physics& physics);
    void appear(Physics& physics, const GameSite& site, std::uint32_t draw);
    void take_away(Physics& physics, Resource& resource);

    std::optional<GameRules> rules_;
    std::array<Pose2, 2> homes_{};
    std::vector<Resource> resources_;
    std::vector<Delivery> deliveries_;
    RandomStream random_;
    int since_look_ = 0;
    double seconds_ = 0, to_next_second_ = 1;
    std::uint64_t count_ = 0;  ///< seconds begun
};

/// The sites of the challenge: two, drawn from its table, and their reflections.
std::vector<GameSite> challenge_sites(const RandomStream& random);

}  // namespace forage::bug
