// A shipped system driving the robot in a shipped world.
#pragma once

#include <algorithm>
#include <functional>
#include <stdexcept>

#include "bug_interface/module/gazebo_bug.h"
#include "bug_interface/simulation/world.h"
#include "bug_interface/world/sdf_reader.h"
#include "core/engine/simulation.h"
#include "core/model/edit.h"
#include "core/observe/column.h"
#include "core/xml/reader.h"
#include "modules/modules.h"
#include "neurons/neurons.h"
#include "synapses/synapses.h"
#include "tests/support/paths.h"

namespace forage::test {

class ClosedLoop {
  public:
    struct Setup {
        std::string system = "reactive_foraging.iqr", world = "worlds/basic_arena.world";  ///< below systems/
        std::uint64_t seed = 1;
        bool noise = true;
        std::vector<std::string> set = {};  ///< as --set
        std::function<void(model::System&)> edit_system = {};
        std::function<void(bug::WorldDescription&)> edit_world = {};
    };

    explicit ClosedLoop(const Setup& setup) {
        Diagnostics diagnostics;
        const auto systems = source_dir() / "systems";
        auto system = xml::read_system(systems / setup.system, diagnostics);
        auto description = bug::read_world(systems / setup.world, diagnostics);
        if (system && setup.edit_system) setup.edit_system(*system);
        if (description && setup.edit_world) setup.edit_world(*description);
        if (system && description) {
            bug::WorldOptions options;
            options.seed = setup.seed;
            options.cycles_per_second = system->cycles_per_second;
            options.noise = setup.noise;
            world = bug::World::make(*description, options, diagnostics);
            add_neurons(registry);
            add_synapses(registry);
            add_modules(registry);
            registry.add(bug::gazebo_bug_type());
            for (const auto& assignment : setup.set) model::set(*system, registry, assignment, diagnostics);
            parsed_ = *system;
            simulation =
                engine::Simulation::build(*system, registry, engine::Demand::everything(),
                                          {.seed = setup.seed, .environment = world.get()}, diagnostics);
        }
        if (!simulation || !world) throw std::runtime_error(format(diagnostics));
        simulation->start();
    }
    ClosedLoop(const ClosedLoop&) = delete;
    ClosedLoop& operator=(const ClosedLoop&) = delete;

    void step() {
        simulation->step();
        world->step();
    }
    /// Runs until this many trials have ended. Throws when a trial takes more than 1000 cycles on average.
    void run_trials(std::size_t count) {
        while (world->trials(0).size() < count) {
            if (simulation->cycle() > 1000 * count) throw std::runtime_error("the trials do not end");
            step();
        }
    }
    /// Changes a parameter from now on, as --schedule does.
    void set(std::string_view assignment) {
        Diagnostics diagnostics;
        const auto change = model::parse_assignment(parsed_, registry, assignment, "test", diagnostics);
        if (!change) throw std::runtime_error(format(diagnostics));
        simulation->set(*change);
    }
    Pose2 pose() const { return world->pose(0); }
    /// The activity of "Process/Group".
    ConstColumn activity(std::string_view group) const {
        Diagnostics diagnostics;
        const auto column = observe::find_column(simulation->layout(), group, "test", diagnostics);
        if (!column) throw std::runtime_error(format(diagnostics));
        return observe::values(*simulation, *column);
    }

    Registry registry;
    std::unique_ptr<bug::World> world;
    std::optional<engine::Simulation> simulation;

  private:
    model::System parsed_;
};

/// Keeps only the connections with these ids.
inline auto keep_connections(std::vector<std::string> ids) {
    return [ids = std::move(ids)](model::System& system) {
        std::erase_if(system.connections,
                      [&](const auto& c) { return std::find(ids.begin(), ids.end(), c.id) == ids.end(); });
    };
}

/// Moves the robot to another start pose.
inline auto start_at(double x, double y, double yaw) {
    return [=](bug::WorldDescription& world) {
        for (auto& model : world.models)
            if (model.name == "Bug") {
                model.pose = bug::Pose::Identity();
                model.pose.translation() = Eigen::Vector3d(x, y, 0);
                model.pose.linear() = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
            }
    };
}

}  // namespace forage::test
