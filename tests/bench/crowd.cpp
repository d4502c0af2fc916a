// How much do several robots cost? Eight robots run in an arena, and each of them runs alone with the same
// commands and all sensors.
//
//     bench_crowd
//
// The robots wander, meet walls and each other, and open and close their grippers. The last result is in
// docs/design/performance.md.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <vector>

#include <fmt/format.h>

#include "bug_interface/simulation/world.h"
#include "bug_interface/world/sdf_reader.h"
#include "core/base/random.h"
#include "tests/bench/report.h"

namespace {

using namespace forage;
using Clock = std::chrono::steady_clock;

/// The team arena with some of eight robots in a ring.
std::unique_ptr<bug::World> arena(const bug::WorldDescription& read, std::vector<int> robots,
                                  Diagnostics& diagnostics) {
    bug::WorldDescription world = read;
    world.game.reset();
    bug::Model robot;
    for (const auto& m : world.models)
        if (m.name == "A_1") robot = m;
    std::erase_if(world.models,
                  [](const bug::Model& m) { return m.name.starts_with("A_") || m.name.starts_with("B_"); });
    for (const int i : robots) {
        const double angle = 2 * M_PI * i / 8;
        robot.name = fmt::format("R{}", i);
        robot.pose = bug::in_space({4 * std::cos(angle), 4 * std::sin(angle), angle});
        world.models.push_back(robot);
    }
    return bug::World::make(world, {}, diagnostics);
}

/// A world that is driven in blocks of cycles, so that two of them can take turns.
class Course {
  public:
    /// `first` is the number of the first robot. Each robot gets the same commands in every world.
    Course(std::unique_ptr<bug::World> world, std::uint32_t first) : world_(std::move(world)), first_(first) {
        for (std::size_t i = 0; i < world_->bugs(); ++i)
            world_->request_image(i, true), world_->request_gripper_scan(i, true);
    }

    static constexpr std::uint64_t block = 250;  ///< cycles
    using Parts = std::array<double, 3>;         ///< motion, scans, pictures; us per cycle

    Parts drive() {
        Parts times{};
        const auto timed = [](double& sum, auto&& part) {
            const auto begin = Clock::now();
            part();
            sum += 1e6 * std::chrono::duration<double>(Clock::now() - begin).count() / block;
        };
        for (std::uint64_t end = cycle_ + block; cycle_ < end; ++cycle_) {
            for (std::size_t i = 0; i < world_->bugs(); ++i) {
                const auto n = 3 * (first_ + static_cast<std::uint32_t>(i));
                world_->command(i, {1.4 * random_.uniform(cycle_ / 25, n) - 0.2,
                                    3 * random_.uniform(cycle_ / 25, n + 1) - 1.5});
                world_->grip(i, random_.uniform(cycle_ / 100, n + 2) < 0.5);
            }
            timed(times[0], [&] { world_->advance_bodies(); });
            timed(times[1], [&] { world_->scan(); });
            timed(times[2], [&] { world_->render(); });
        }
        return times;
    }
    /// The share of the substeps in which Bullet was called.
    double contacts() const {
        return static_cast<double>(world_->physics().contact_steps()) /
               static_cast<double>(world_->substeps());
    }

  private:
    std::unique_ptr<bug::World> world_;
    std::uint32_t first_;
    RandomStream random_{3, "drive"};
    std::uint64_t cycle_ = 0;
};

double sum(const Course::Parts& parts) { return parts[0] + parts[1] + parts[2]; }

void tell(int robots, const Course::Parts& mean, double contacts) {
    fmt::print(
        "{} robot{} {:7.1f} us per cycle of 40 ms: motion {:.1f}, scans {:.1f}, pictures {:.1f}; contacts "
        "looked "
        "for in {:.0f} % of the steps\n",
        robots, robots > 1 ? "s" : " ", sum(mean), mean[0], mean[1], mean[2], 100 * contacts);
}

}  // namespace

int main() {
    Diagnostics diagnostics;
    const auto read =
        bug::read_world(std::string(FORAGE_SOURCE_DIR) + "/systems/worlds/team_arena.world", diagnostics);
    std::vector<Course> alone, crowd;
    for (const std::vector<int>& robots :
         std::vector<std::vector<int>>{{0}, {1}, {2}, {3}, {4}, {5}, {6}, {7}, {0, 1, 2, 3, 4, 5, 6, 7}}) {
        auto world = read ? arena(*read, robots, diagnostics) : nullptr;
        if (!world) {
            fmt::print(stderr, "{}", format(diagnostics));
            return 2;
        }
        auto& courses = robots.size() == 1 ? alone : crowd;
        courses.emplace_back(std::move(world), static_cast<std::uint32_t>(robots.front()));
    }
    // The worlds take turns, as the speed of a busy machine changes.
    constexpr int rounds = 20;
    Course::Parts mean_alone{}, mean_crowd{};
    std::vector<double> ratios;
    for (int round = 0; round < rounds; ++round) {
        Course::Parts a{}, c{};
        const auto add = [](Course::Parts& to, const Course::Parts& from, double weight) {
            for (std::size_t i = 0; i < to.size(); ++i) to[i] += weight * from[i];
        };
        for (Course& course : alone) {
            add(a, course.drive(), 1.0 / 8);
            if (&course == &alone[3]) add(c, crowd.front().drive(), 1);
        }
        add(mean_alone, a, 1.0 / rounds), add(mean_crowd, c, 1.0 / rounds);
        ratios.push_back(sum(a) / sum(c));
    }
    std::sort(ratios.begin(), ratios.end());
    double contacts = 0;
    for (const Course& course : alone) contacts += course.contacts() / 8;
    tell(1, mean_alone, contacts), tell(8, mean_crowd, crowd.front().contacts());
    fmt::print(
        "8 robots run at {:.3f} of the rate of one (median of {} rounds, quartiles {:.3f} and {:.3f})\n",
        ratios[rounds / 2], rounds, ratios[rounds / 4], ratios[3 * rounds / 4]);
    bench::result("crowd", "rate of 8 robots / of one", ratios[rounds / 2], "");
}
