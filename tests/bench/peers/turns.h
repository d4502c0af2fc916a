// The main program of a simulator in the comparison of robots.
//
//     peer_NAME SCENE [STEPS]
//
// STEPS are the physics steps in a cycle of 80 ms, 80 by default. Answers each line of its input. A number of
// seconds: simulates for about as long, in processor time, and prints seconds of the world per second.
// "check": simulates 60 s and prints what can be compared with other simulators: the mean distance that all
// rays measure, the mean speed of the robots, the place of the first robot, and the deepest overlap of two
// shapes.
#pragma once

#include <cstdio>
#include <iostream>
#include <string>

#include <time.h>

#include "tests/bench/peers/scene.h"

namespace peers {

inline double processor_seconds() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Drives a World in a scene. A World has command(robot, Command), advance() by a cycle, scan() of all
/// robots, pose(robot), ball(number) and range(robot, ray).
template <class World>
class Drive {
  public:
    explicit Drive(const Scene& scene) : scene_(scene), driver_(scene), world_(scene) {}

    void cycle() {
        for (std::size_t i = 0; i < scene_.robots.size(); ++i)
            world_.command(i, driver_.command(i, world_.pose(i)));
        world_.advance();
        world_.scan();
    }

    void check() {
        double ranges = 0, way = 0, overlap = 0;
        const int cycles = 750;
        const auto robots = scene_.robots.size();
        for (int c = 0; c < cycles; ++c) {
            std::vector<Pose> before;
            for (std::size_t i = 0; i < robots; ++i) before.push_back(world_.pose(i));
            cycle();
            for (std::size_t i = 0; i < robots; ++i) {
                way += std::hypot(world_.pose(i).x - before[i].x, world_.pose(i).y - before[i].y);
                for (int ray = 0; ray < rays; ++ray) ranges += world_.range(i, ray);
            }
            overlap = std::max(overlap, deepest_overlap());
        }
        const double n = cycles * static_cast<double>(robots);
        std::printf("%.6f %.6f %.6f %.6f %.6f\n", ranges / n / rays, way / n / peers::cycle, world_.pose(0).x,
                    world_.pose(0).y, overlap);
    }

    void measure(double seconds) {
        const double begin = processor_seconds();
        double elapsed = 0;
        long cycles = 0;
        for (long block = 1; elapsed < seconds; block = std::min(2 * block, 256L)) {
            for (long c = 0; c < block; ++c) cycle();
            cycles += block;
            elapsed = processor_seconds() - begin;
        }
        std::printf("%.3f\n", static_cast<double>(cycles) * peers::cycle / elapsed);
    }

  private:
    double deepest_overlap() const {
        struct Disc {
            Pose at;
            double radius;
        };
        std::vector<Disc> discs;
        for (std::size_t i = 0; i < scene_.robots.size(); ++i)
            discs.push_back({world_.pose(i), robot_radius});
        for (std::size_t i = 0; i < scene_.balls.size(); ++i) discs.push_back({world_.ball(i), ball_radius});
        double deepest = 0;
        for (std::size_t i = 0; i < discs.size(); ++i) {
            const auto& [at, radius] = discs[i];
            deepest = std::max(
                {deepest, std::abs(at.x) + radius - scene_.half_x, std::abs(at.y) + radius - scene_.half_y});
            for (std::size_t k = 0; k < i; ++k)
                deepest = std::max(deepest, radius + discs[k].radius -
                                                std::hypot(at.x - discs[k].at.x, at.y - discs[k].at.y));
        }
        return deepest;
    }

    Scene scene_;
    Driver driver_;
    World world_;
};

template <class World>
int serve(int argc, char** argv) {
    if (argc < 2) {
        std::cerr << argv[0] << " open | wall | corner | crowd [STEPS]\n";
        return 2;
    }
    Scene scene = make_scene(argv[1]);
    if (argc > 2) scene.steps = std::stoi(argv[2]);
    Drive<World> drive(scene);
    for (std::string line; std::getline(std::cin, line);) {
        line == "check" ? drive.check() : drive.measure(std::stod(line));
        std::fflush(stdout);
    }
    return 0;
}

}  // namespace peers
