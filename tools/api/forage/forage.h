// Forage inside another program: load a system, step it, read and write its states.
//
//     auto model = forage::load("system.iqr");
//     const int motor = model.group("Bug/Motor"), vm = model.state(motor, "vm");
//     for (int i = 0; i < 1000; ++i) {
//         model.step();
//         std::cout << model.state(motor, vm).sum() << '\n';
//     }
//
// The public interface is this header and what it includes: forage::engine::Simulation (the cycle, and
// states as Eigen maps of the simulation's own memory), forage::model (systems as values, to be made or
// edited in code: "core/model/build.h") and forage::Registry. It keeps its meaning within a version that
// find_package(Forage VERSION) accepts.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "core/engine/simulation.h"
#include "core/model/build.h"
#include "core/types/registry.h"

namespace forage {

/// What is wrong with files, systems, plugins or assignments: what() is all of it, as `forage check` prints
/// it.
class InputError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct LoadOptions {
    std::vector<std::string> plugins = {};  ///< shared objects and folders of them; nothing else is searched
    std::uint64_t seed = 1;                 ///< decides everything random
    int threads = 1;                        ///< the numbers do not depend on it
    bool lenient = false;                   ///< unknown parameters and attributes of files are no errors
};

/// A system that runs, and whose parts can be named.
class Model : public engine::Simulation {
  public:
    Model(model::System system, Registry types, engine::Simulation simulation);

    const model::System& system() const { return system_; }  ///< as it was built
    const Registry& types() const { return types_; }

    /// The number of a group by its path, "Process/Group". Throws std::invalid_argument, with what was
    /// probably meant.
    int group(std::string_view path) const;
    /// The number of a group's state by its name: "vm". Throws as the other one.
    int state(int group, std::string_view name) const;
    using Simulation::state;

    /// Changes a parameter between two cycles: "Process/Group.parameter=value", "Process.parameter=value" of
    /// a module, "Connection.parameter=value" of a synapse. Throws InputError.
    void set(std::string_view assignment);
    using Simulation::set;

  private:
    model::System system_;
    Registry types_;
};

/// The types that need no robot, and those of plugins. Throws InputError.
Registry types(const std::vector<std::string>& plugins = {});

/// Builds a system and starts its modules: ready for step(). Throws InputError, and engine::RunError from
/// the start of a module. `options.plugins` is not looked at.
Model build(model::System system, Registry types, const LoadOptions& options = {});

/// Reads a system file (.iqr) and builds it. Throws as build().
Model load(const std::string& path, const LoadOptions& options = {});

}  // namespace forage
