#include "bug_interface/simulation/game.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace forage::bug {
namespace {

constexpr std::uint64_t substeps_per_check = 101;  ///< the original skips 100
constexpr int held_contacts = 100;                 ///< between two checks; more mean that a resource is held
constexpr double spread = 0.5;                     ///< m around a site

/// Random numbers are indexed by the second and by their use.
enum Draw : std::uint32_t { shuffle, chance, position };
constexpr std::uint64_t site_draws = ~std::uint64_t{0};  ///< instead of a second

}  // namespace

std::vector<GameSite> challenge_sites(const RandomStream& random) {
    constexpr std::array<std::pair<double, double>, 6> table = {
        {{-3, 3}, {0, 7.5}, {-6, 6}, {7.5, 4}, {10.5, 10.5}, {12, 4.5}}};
    const auto pick = [&](std::uint32_t draw, std::size_t first, std::size_t count) {
        return table[first + static_cast<std::size_t>(random.uniform(site_draws, 0, draw) *
                                                      static_cast<double>(count))];
    };
    const auto [ax, ay] = pick(0, 0, 4);
    const auto [bx, by] = pick(1, 3, 3);
    const bool a_is_rich = random.uniform(site_draws, 0, 2) < 0.5;
    const double a = a_is_rich ? 0.15 : 0.1, b = a_is_rich ? 0.1 : 0.15;
    return {{ax, ay, a}, {-ax, -ay, a}, {bx, by, b}, {-bx, -by, b}};
}

Game::Game(std::optional<GameRules> rules, std::array<Pose2, 2> homes, std::vector<Resource> resources,
           std::uint64_t seed)
    : rules_(std::move(rules)), homes_(homes), resources_(std::move(resources)), random_(seed, "game") {
    if (rules_ && rules_->sites.empty()) rules_->sites = challenge_sites(random_);
}

void Game::begin(Physics& physics) {
    if (rules_)
        for (Resource& r : resources_) remove(physics, r);
}

void Game::remove(Physics& physics, Resource& r) {
    physics.remove(r.body);
    r.removed = true, r.held = false, r.age = 0, r.contacts = 0;
}

std::uint64_t Game::substeps_to_event(double step) const {
    std::uint64_t left = substeps_per_check - std::min(since_check_, substeps_per_check - 1);
    if (!rules_) return left;
    const double to_second = std::ceil(to_next_second_ / step - 0.5);
    return to_second < 1 ? 1 : std::min(left, static_cast<std::uint64_t>(to_second));
}

void Game::advance(Physics& physics, double time, double step, std::uint64_t steps) {
    if (over()) return;
    for (Resource& r : resources_) r.contacts += physics.robot_contacts(r.body);
    since_check_ += steps;
    if (since_check_ >= substeps_per_check) {
        since_check_ = 0;
        check_resources(physics, time);
    }
    if (!rules_) return;
    elapsed_ += static_cast<double>(steps) * step;
    to_next_second_ -= static_cast<double>(steps) * step;
    if (to_next_second_ > step / 2) return;
    to_next_second_ += 1;
    if (over())
        begin(physics);  // removes all resources
    else
        advance_second(physics);
}

void Game::check_resources(Physics& physics, double time) {
    for (Resource& r : resources_) {
        r.held = std::exchange(r.contacts, 0) > held_contacts;
        if (r.removed) continue;
        const Pose2& at = physics.pose(r.body);
        for (const int team : {1, 0}) {  // where the homes overlap, team B scores
            const Pose2& home = homes_[static_cast<std::size_t>(team)];
            if (std::hypot(at.x - home.x, at.y - home.y) >= home_radius) continue;
            const int points = !rules_ ? 1 : r.good ? rules_->points : rules_->penalty;
            deliveries_.push_back({time, team, r.good, points});
            if (rules_)
                remove(physics, r);
            else
                physics.place(r.body, r.start);
            break;
        }
    }
}

void Game::advance_second(Physics& physics) {
    ++seconds_begun_;
    for (Resource& r : resources_) {
        if (r.removed || r.held) continue;
        ++r.age;
        if (r.age >= rules_->stale_after) r.good = false;
        if (r.age >= rules_->dissolves_after) remove(physics, r);
    }
    std::vector<GameSite> sites = rules_->sites;
    for (std::size_t i = sites.size(); i > 1; --i)
        std::swap(sites[i - 1], sites[static_cast<std::size_t>(
                                    random_.uniform(seconds_begun_, static_cast<std::uint32_t>(i), shuffle) *
                                    static_cast<double>(i))]);
    for (std::uint32_t i = 0; i < sites.size(); ++i)
        if (random_.uniform(seconds_begun_, i, chance) < sites[i].chance) spawn(physics, sites[i], i);
}

/// Places a removed resource near a site, unless there is no such resource or the position is occupied.
void Game::spawn(Physics& physics, const GameSite& site, std::uint32_t draw) {
    const auto free = std::ranges::find_if(resources_, &Resource::removed);
    if (free == resources_.end()) return;
    const double angle = 2 * std::numbers::pi * random_.uniform(seconds_begun_, 2 * draw, position),
                 radius = spread * random_.uniform(seconds_begun_, 2 * draw + 1, position);
    const Pose2 at{site.x + radius * std::cos(angle), site.y + radius * std::sin(angle), 0};
    if (!physics.is_collision_free(free->body, at)) return;
    physics.place(free->body, at);
    free->removed = false, free->good = true, free->held = false, free->age = 0, free->contacts = 0;
}

double Game::left() const {
    constexpr double rounding = 1e-6;  // s; the accumulated error of many steps
    return rules_ && elapsed_ < rules_->duration - rounding ? rules_->duration - elapsed_ : 0;
}

int Game::points(int team) const {
    int sum = 0;
    for (const Delivery& d : deliveries_) sum += d.team == team ? d.points : 0;
    return sum;
}

int Game::delivered(int team, bool good) const {
    return static_cast<int>(std::ranges::count_if(
        deliveries_, [&](const Delivery& d) { return d.team == team && d.good == good; }));
}

}  // namespace forage::bug
