#include "tools/forage/load.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>

#include "bug_interface/module/gazebo_bug.h"
#include "bug_interface/world/sdf_reader.h"
#include "core/model/build.h"
#include "core/model/edit.h"
#include "core/base/named_file.h"
#include "core/model/validate.h"
#include "core/plugin/search.h"
#include "core/xml/reader.h"
#include "modules/modules.h"
#include "modules/replay/replay.h"
#include "neurons/neurons.h"
#include "synapses/synapses.h"

namespace forage::tool {
namespace {

std::shared_ptr<const replay::DriveTable> read_table(const std::string& path, Diagnostics& diagnostics) {
    if (path.empty()) return nullptr;
    try {
        return std::make_shared<replay::DriveTable>(replay::DriveTable::read(path));
    } catch (const FileError& e) {
        report(e, diagnostics);
        return nullptr;
    }
}

/// Makes every enabled moduleReplay that names no table of its own play this one.
void play(const replay::DriveTable& table, model::System& system) {
    for (auto& p : system.processes) {
        if (!p.module || p.module->type != "moduleReplay") continue;
        auto& settings = p.module->settings;
        const auto file =
            std::find_if(settings.begin(), settings.end(), [](const auto& s) { return s.name == "file"; });
        if (file == settings.end())
            settings.push_back({"file", table.file()->path, {}, {}});
        else if (file->value.empty())
            file->value = table.file()->path, file->value_at = {};
    }
}

/// A system, or a process file as a system of one process.
std::optional<model::System> read_any(const std::string& path, Diagnostics& diagnostics) {
    if (std::filesystem::path(path).extension() != ".iqrProcess") return xml::read_system(path, diagnostics);
    auto file = xml::read_process(path, diagnostics);
    if (!file) return std::nullopt;
    model::System system;
    system.name = file->process.name;
    system.processes.push_back(std::move(file->process));
    system.connections = std::move(file->connections);
    return system;
}

}  // namespace

Registry shipped_types() {
    Registry registry;
    add_neurons(registry);
    add_synapses(registry);
    add_modules(registry);
    registry.add(module_type<replay::Replay>());
    registry.add(bug::gazebo_bug_type());
    return registry;
}

std::vector<plugin::Plugin> load_plugins(const std::vector<std::string>& named, const std::string& system,
                                         Diagnostics& diagnostics) {
    const char* path = std::getenv("FORAGE_PLUGIN_PATH");
    const auto files = plugin::find(named, path ? path : "", system, diagnostics);
    if (files.empty()) return {};
    return plugin::load(files, shipped_types(), diagnostics);
}

Registry known_types(const std::vector<plugin::Plugin>& plugins) {
    Registry registry = shipped_types();
    plugin::add(plugins, registry);
    return registry;
}

double cycles_per_second(const model::System& system) {
    return system.cycles_per_second > 0 ? system.cycles_per_second : 25;
}

Sources read(const Input& input, Diagnostics& diagnostics) {
    diagnostics.lenient = input.lenient;
    Sources out;
    out.system = read_any(input.system, diagnostics);
    for (const std::string& path : input.more) {
        auto other = read_any(path, diagnostics);
        if (!out.system || !other) continue;
        if (other->cycles_per_second != out.system->cycles_per_second)
            diagnostics.error(
                other->at,
                fmt::format("this system runs at {} cycles per second, '{}' at {}", other->cycles_per_second,
                            input.system, out.system->cycles_per_second),
                "systems that run together need the same cyclesPerSecond");
        model::join(*out.system, std::move(*other));
    }
    if (!input.world.empty()) out.world = bug::read_world(input.world, diagnostics);
    out.drive = read_table(input.drive, diagnostics);
    const int errors_before = diagnostics.errors();
    out.plugins = load_plugins(input.plugins, input.system, diagnostics);
    out.plugins_failed = diagnostics.errors() > errors_before;
    return out;
}

std::optional<Loaded> assemble(const Sources& sources, const Input& input, Diagnostics& diagnostics) {
    Loaded out;
    if (sources.system) out.system = *sources.system;
    if (sources.world) {
        bug::WorldOptions options;
        options.seed = input.seed;
        options.cycles_per_second = cycles_per_second(out.system);
        options.real_time_factor = input.world_pace;
        options.noise = input.noise;
        options.native_rates = input.sensor_rates;
        options.late = input.latency;
        options.game = input.game;
        out.world = bug::World::make(*sources.world, options, diagnostics);
    }
    if (sources.drive) play(*sources.drive, out.system);
    out.registry = shipped_types();
    plugin::add(sources.plugins, out.registry);
    for (const auto& p : sources.plugins) out.plugins.push_back(p.path);
    if (sources.system && !sources.plugins_failed) {
        for (const auto& wish : input.settings)
            model::set(out.system, out.registry, wish.text, diagnostics, wish.at);
        if (diagnostics.failed())
            model::validate(out.system, out.registry, diagnostics, out.world.get());  // say all of it at once
    }
    if (diagnostics.failed()) return std::nullopt;
    return out;
}

std::optional<Loaded> load(const Input& input, Diagnostics& diagnostics) {
    return assemble(read(input, diagnostics), input, diagnostics);
}

}  // namespace forage::tool
