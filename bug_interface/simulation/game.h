// The game of the robotics challenge, in which two teams collect resources: its score and its clock.
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

/// A resource that was brought to a home.
struct Delivery {
    double time = 0;   ///< simulated time, s
    int team = 0;      ///< 0 for A, 1 for B
    bool good = true;  ///< blue; else yellow
    int points = 0;
    void checkpoint(Archive& archive) { archive(time, team, good, points); }
};

/// The state of a game. Resources are movable objects with the target plugin. In every 101st substep each
/// resource is checked. When its centre is within 3 m of a home it counts for that team (for B when it is at
/// both homes) and returns to its start pose. A resource is held when it had more than 100 contacts with
/// robots since the last check.
///
/// With rules there is a clock. Once per second every resource that is not held ages. Old resources turn bad
/// (yellow) and later dissolve, and new good resources (blue) appear at the sites. Resources that are not in
/// play, and all resources when the time is over, are removed from the physics; the original hid them in the
/// central pillar.
class Game {
  public:
    struct Resource {
        std::size_t body = 0;  ///< number among the bodies
        Pose2 start;           ///< the pose to which it returns without rules
        bool removed = false, good = true, held = false;
        int age = 0;       ///< s
        int contacts = 0;  ///< number of contacts with robots since the last check
        void checkpoint(Archive& archive) { archive(start, removed, good, held, age, contacts); }
    };

    Game() = default;
    /// `homes` are the homes of team A and B, m. Without `rules`, resources only count at the homes.
    Game(std::optional<GameRules> rules, std::array<Pose2, 2> homes, std::vector<Resource> resources,
         std::uint64_t seed);

    /// Called before the first substep. With rules, all resources are removed until they appear at a site.
    void begin(Physics& physics);
    /// The number of substeps of `step` s until something may happen: at least 1.
    std::uint64_t substeps_to_event(double step) const;
    /// Called after `steps` substeps of `step` s, at most substeps_to_event(). `time` is the simulated time,
    /// s.
    void advance(Physics& physics, double time, double step, std::uint64_t steps);

    bool empty() const { return resources_.empty(); }
    bool timed() const { return rules_.has_value(); }
    bool over() const { return rules_ && left() == 0; }
    double left() const;  ///< remaining time, s
    const std::vector<Resource>& resources() const { return resources_; }
    const std::vector<Delivery>& deliveries() const { return deliveries_; }
    const std::array<Pose2, 2>& homes() const { return homes_; }
    /// The name of a team: "A" or "B".
    static std::string team_name(int team) { return team == 0 ? "A" : "B"; }
    int points(int team) const;
    int delivered(int team, bool good) const;  ///< number of resources

    void checkpoint(Archive& archive) {
        archive(resources_, deliveries_, since_check_, elapsed_, to_next_second_, seconds_begun_);
    }

    static constexpr double home_radius = 3;  ///< m

  private:
    void check_resources(Physics& physics, double time);
    void advance_second(Physics& physics);
    void spawn(Physics& physics, const GameSite& site, std::uint32_t draw);
    void remove(Physics& physics, Resource& resource);

    std::optional<GameRules> rules_;
    std::array<Pose2, 2> homes_{};
    std::vector<Resource> resources_;
    std::vector<Delivery> deliveries_;
    RandomStream random_;
    std::uint64_t since_check_ = 0;            ///< substeps
    double elapsed_ = 0, to_next_second_ = 1;  ///< s
    std::uint64_t seconds_begun_ = 0;
};

/// The sites of the challenge: two that are drawn from its table, and their reflections about the centre.
std::vector<GameSite> challenge_sites(const RandomStream& random);

}  // namespace forage::bug
