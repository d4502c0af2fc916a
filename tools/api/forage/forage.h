// Forage inside another program: open a system with its world, step it, read, record and change it.
//
//     auto run = forage::open("dac_foraging.iqr", {.world = "basic_arena.world", .seed = 1});
//     const auto& light = run.record("Bug/Light");
//     run.until({.trials = 30});
//     std::cout << light.rows().rowwise().mean() << '\n';
//     for (const auto& trial : run.trials().finished) std::cout << trial.number << ' ' << trial.reached_target << '\n';
//
// The public interface is this header and what it includes: forage::Run, forage::Observer, forage::Environment, the cycle itself
// (forage::engine::Simulation), systems as values (forage::model, "core/model/build.h") and forage::Registry. It keeps its
// meaning within a version that find_package(Forage VERSION) accepts.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/model/build.h"
#include "core/run/run.h"
#include "core/types/registry.h"

namespace forage {

struct OpenOptions {
    std::string world = {};                        ///< file of the world in which the robots live; none when empty
    std::uint64_t seed = 1;                        ///< decides everything random
    std::vector<std::string> settings = {};        ///< "Process/Group.parameter=value", as for `forage run --set`
    std::vector<std::string> plugins = {};         ///< shared objects and folders of them; nothing else is searched
    int threads = 1;                               ///< at most; the numbers do not depend on it
    bool lenient = false;                          ///< unknown parameters and attributes of files are no errors
    bool noise = true;                             ///< of motors and sensors
    std::optional<double> real_time_factor = {};   ///< seconds of the world per second of the clock; empty: the world's own
    /// Compute all groups, so that everything can be read and changed at any time. Otherwise the run computes what observers,
    /// added before the first cycle, and modules read: faster, with the same numbers.
    bool compute_everything = true;
};

/// Opens a system file (.iqr) with its world: ready for step(). Throws InputError.
Run open(const std::string& system, const OpenOptions& options = {});
/// The same for a system that was made in code, and the types that it uses, in an environment of the caller, which may be null.
/// Throws InputError. Of `options`, world, plugins, lenient, noise and real_time_factor are not looked at.
Run open(model::System system, Registry types, std::unique_ptr<Environment> environment = nullptr,
         const OpenOptions& options = {});

/// The types that ship, and those of plugins. Throws InputError.
Registry types(const std::vector<std::string>& plugins = {});

}  // namespace forage
