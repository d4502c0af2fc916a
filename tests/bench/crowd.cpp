// How much do several robots cost? Eight robots run in an arena, each of them runs alone with the same
// commands and all sensors, and 64 run in eight such arenas without walls between them.
//
//     bench_crowd
//
// The robots wander, meet walls and each other, and open and close their grippers. The last result is in
// docs/design/performance.md.
#include <algorithm>
#include <array>
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

/// `tiles` team arenas, two of them above each other, inside one wall, with these robots. There are eight
/// robots per arena, in a ring.
std::unique_ptr<bug::World> arena(const bug::WorldDescription& read, std::vector<int> robots, int tiles,
                                  Diagnostics& diagnostics) {
    constexpr double side = 14;
    const int wide = (tiles + 1) / 2, high = std::min(tiles, 2);
    const auto corner = [&](int tile) {
        return Eigen::Vector3d((tile / 2 - (wide - 1) / 2.0) * side, (tile % 2 - (high - 1) / 2.0) * side, 0);
    };
    bug::WorldDescription world = read;
    world.game.reset();
    world.models.clear();
    bug::Model robot;
    for (bug::Model m : read.models) {
        if (m.name == "A_1") robot = m;
        if (m.name.starts_with("A_") || m.name.starts_with("B_")) continue;
        for (int tile = 0; tile < (m.name == "Walls" || m.name.starts_with("Home_") ? tiles : 1); ++tile) {
            bug::Model copy = m;
            copy.pose.pretranslate(corner(tile));
            copy.name += tile ? std::to_string(tile) : "";
            std::erase_if(copy.links, [&](const bug::Link& link) {  // walls between arenas
                const Eigen::Vector3d at = copy.pose * link.pose.translation();
                return m.name == "Walls" && std::abs(at.x()) < wide * side / 2 - 0.1 &&
                       std::abs(at.y()) < high * side / 2 - 0.1 && !link.name.starts_with("pillar");
            });
            for (bug::Link& link : copy.links)
                for (bug::Visual& v : link.visuals)
                    if (v.shape.kind == bug::ShapeKind::plane) v.shape.size *= 4;
            world.models.push_back(copy);
        }
    }
    for (const int i : robots) {
        const double angle = 2 * M_PI * i / 8;
        robot.name = fmt::format("R{}", i);
        robot.pose = bug::in_space({4 * std::cos(angle), 4 * std::sin(angle), angle});
        robot.pose.pretranslate(corner(i / 8));
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

    using Parts = std::array<double, 3>;  ///< motion, scans, pictures; us per cycle

    Parts drive(std::uint64_t cycles = 250) {
        Parts times{};
        const auto timed = [&](double& sum, auto&& part) {
            const double begin = bench::thread_seconds();
            part();
            sum += 1e6 * (bench::thread_seconds() - begin) / static_cast<double>(cycles);
        };
        for (std::uint64_t end = cycle_ + cycles; cycle_ < end; ++cycle_) {
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
    /// The mean number of strides per cycle in which contacts were near.
    double contacts() const {
        return static_cast<double>(world_->physics().contact_steps()) / static_cast<double>(world_->cycle());
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
        "{} robot{} {:7.1f} us per cycle of 40 ms: motion {:.1f}, scans {:.1f}, pictures {:.1f}; {:.1f} "
        "strides "
        "with contacts near\n",
        robots, robots > 1 ? "s" : " ", sum(mean), mean[0], mean[1], mean[2], contacts);
}

}  // namespace

int main() {
    Diagnostics diagnostics;
    const auto read =
        bug::read_world(std::string(FORAGE_SOURCE_DIR) + "/systems/worlds/team_arena.world", diagnostics);
    std::vector<std::vector<int>> runs = {{0}, {1}, {2}, {3}, {4}, {5}, {6}, {7}, {}, {}};
    for (int i = 0; i < 64; ++i) {
        if (i < 8) runs[8].push_back(i);
        runs[9].push_back(i);
    }
    std::vector<Course> alone, crowd;  // the crowd of 8 and that of 64
    for (const std::vector<int>& robots : runs) {
        auto world = read ? arena(*read, robots, robots.size() > 8 ? 8 : 1, diagnostics) : nullptr;
        if (!world) {
            fmt::print(stderr, "{}", format(diagnostics));
            return 2;
        }
        auto& courses = robots.size() == 1 ? alone : crowd;
        courses.emplace_back(std::move(world), static_cast<std::uint32_t>(robots.front()));
    }
    // The worlds take turns, as the speed of a busy machine changes.
    constexpr int rounds = 20;
    Course::Parts mean_alone{}, mean_crowd{}, mean_64{};
    std::vector<double> ratios, of_64, senses_of_64;
    for (int round = 0; round < rounds; ++round) {
        Course::Parts a{}, c{}, many{};
        const auto add = [](Course::Parts& to, const Course::Parts& from, double weight) {
            for (std::size_t i = 0; i < to.size(); ++i) to[i] += weight * from[i];
        };
        for (Course& course : alone) {
            add(a, course.drive(), 1.0 / 8);
            if (&course == &alone[3]) add(c, crowd[0].drive(), 1), add(many, crowd[1].drive(25), 1);
        }
        add(mean_alone, a, 1.0 / rounds), add(mean_crowd, c, 1.0 / rounds), add(mean_64, many, 1.0 / rounds);
        ratios.push_back(sum(a) / sum(c));
        of_64.push_back(sum(many) / sum(c));
        senses_of_64.push_back((many[1] + many[2]) / (c[1] + c[2]));
    }
    std::sort(ratios.begin(), ratios.end());
    double contacts = 0;
    for (const Course& course : alone) contacts += course.contacts() / 8;
    tell(1, mean_alone, contacts), tell(8, mean_crowd, crowd[0].contacts()),
        tell(64, mean_64, crowd[1].contacts());
    fmt::print(
        "8 robots run at {:.3f} of the rate of one (median of {} rounds, quartiles {:.3f} and {:.3f})\n",
        ratios[rounds / 2], rounds, ratios[rounds / 4], ratios[3 * rounds / 4]);
    bench::result("crowd", "rate of 8 robots / of one", ratios[rounds / 2], "");
    fmt::print("64 robots cost {:.1f} times as much as 8, their scans and pictures {:.1f} times\n",
               bench::median(of_64), bench::median(senses_of_64));
    bench::result("crowd", "cost of 64 / of 8", bench::median(of_64), "");
}
