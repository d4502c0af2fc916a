// Worlds for the tests of motion, simulation and the robot's module.
#pragma once

#include <cmath>
#include <map>
#include <memory>
#include <string>

#include "bug_interface/simulation/world.h"
#include "bug_interface/world/sdf_reader.h"
#include "tests/support/catch.h"
#include "tests/support/paths.h"

namespace forage::test {

/// A world of the repository. Each is read only once.
inline const bug::WorldDescription& description(const std::string& name) {
    static std::map<std::string, bug::WorldDescription> known;
    if (!known.contains(name)) {
        Diagnostics diagnostics;
        auto world =
            bug::read_world((source_dir() / "systems/worlds" / (name + ".world")).string(), diagnostics);
        INFO(format(diagnostics));
        REQUIRE(world);
        known[name] = *world;
    }
    return known[name];
}

inline std::unique_ptr<bug::World> make_world(const bug::WorldDescription& description,
                                              bug::WorldOptions options = {}) {
    Diagnostics diagnostics;
    auto world = bug::World::make(description, options, diagnostics);
    INFO(format(diagnostics));
    REQUIRE(world);
    CHECK(diagnostics.all().empty());
    return world;
}

inline bug::Model* find_model(bug::WorldDescription& world, const std::string& name) {
    for (auto& m : world.models)
        if (m.name == name) return &m;
    return nullptr;
}

/// The distance between two positions, m.
inline double apart(const bug::Pose2& a, const bug::Pose2& b) { return std::hypot(a.x - b.x, a.y - b.y); }

}  // namespace forage::test
