#include "tools/api/open/sources.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "bug_interface/module/gazebo_bug.h"
#include "bug_interface/world/sdf_reader.h"
#include "core/base/named_file.h"
#include "core/base/text_file.h"
#include "core/equations/declared_types.h"
#include "core/model/build.h"
#include "core/model/constants.h"
#include "core/model/edit.h"
#include "core/model/lookup.h"
#include "core/model/validate.h"
#include "core/plugin/search.h"
#include "core/xml/reader.h"
#include "modules/devices/devices.h"
#include "modules/modules.h"
#include "modules/replay/replay.h"
#include "neurons/neurons.h"
#include "synapses/synapses.h"
#include "tools/api/open/program_types.h"

namespace forage {
namespace {

std::optional<DriveTable> read_table(const std::string& path, Diagnostics& diagnostics) {
    if (path.empty()) return std::nullopt;
    try {
        return DriveTable::read(path);
    } catch (const FileError& e) {
        report(e, diagnostics);
        return std::nullopt;
    }
}

InputFiles files_of_system(const Sources& sources) {
    InputFiles out = system_files(*sources.system);
    for (const auto& p : sources.plugins)
        if (p.loaded) out[p.path] = file_digest(p.path);
    return out;
}

/// The files that a world includes.
InputFiles files_of_world(const Sources& sources) {
    InputFiles out;
    for (const auto& path : sources.world->files) out[path] = file_digest(path);
    return out;
}

std::string without_paths(const InputFiles& files) {
    std::string out;
    for (const auto& [path, sum] : files) out += sum;
    return digest(out);
}

/// Gives this table to every enabled moduleReplay without a table of its own.
void play(const DriveTable& table, model::System& system) {
    for (auto& p : system.processes) {
        if (!p.module || p.module->type != "moduleReplay") continue;
        auto& settings = p.module->settings;
        const auto file = std::ranges::find(settings, "file", &model::Setting::name);
        if (file == settings.end())
            settings.push_back({"file", table.file()->path, {}, {}});
        else if (file->value.empty())
            file->value = table.file()->path, file->value_at = {};
    }
}

/// An enabled module that drives a robot.
struct Driver {
    const model::Process* process;
    model::ModuleUse* module;
    std::string robot;
    Location at;  ///< where the robot is named, or the module
    bool bound = false;
};

constexpr const char* robot_parameter = "device_name";

std::vector<Driver> drivers_of(model::System& system, const Registry& registry) {
    std::vector<Driver> out;
    for (auto& process : system.processes) {
        const ModuleType* type = process.module ? registry.module(process.module->type) : nullptr;
        if (!type || !process.module_enabled) continue;
        for (const auto& p : type->parameters) {
            if (p.name != robot_parameter) continue;
            Driver driver{&process, &*process.module, to_text(p.default_value), process.module->at};
            for (const auto& s : process.module->settings)
                if (s.name == p.name) driver.robot = s.value, driver.at = s.value_at;
            out.push_back(std::move(driver));
        }
    }
    return out;
}

/// Binds modules to robots: "NAME=ROBOT" binds the first module with the device_name NAME that is not yet
/// bound.
void bind_robots(const std::vector<model::Expression>& bindings, const Registry& registry,
                 model::System& system, Diagnostics& diagnostics) {
    auto drivers = drivers_of(system, registry);
    for (const auto& given : bindings) {
        const std::string& binding = given.text;
        const Location& at = given.at;
        const std::string what = at.file ? "bind" : "--robot";
        const auto equals = binding.find('=');
        const std::string name(model::trim(binding.substr(0, equals)));
        if (equals == std::string::npos || name.empty() || model::trim(binding.substr(equals + 1)).empty()) {
            diagnostics.error(at, fmt::format("{}: '{}' does not name two robots", what, binding),
                              at.file ? "give both names: robot=\"Bug\" to=\"A_1\""
                                      : "write the system's robot, '=', and the world's robot: Bug=A_1");
            continue;
        }
        const auto driver =
            std::ranges::find_if(drivers, [&](const auto& d) { return !d.bound && d.robot == name; });
        if (driver == drivers.end()) {
            std::vector<std::string> names;
            for (const auto& d : drivers)
                if (!d.bound) names.push_back(d.robot);
            diagnostics.error(
                at,
                fmt::format("{}: '{}': no module{} drives a robot '{}'", what, binding,
                            names.size() < drivers.size() ? " that is left" : "", name),
                names.empty() ? fmt::format("every {} binds one module", what) : suggest(name, names));
            continue;
        }
        driver->bound = true;
        model::set_parameter(*driver->module, robot_parameter,
                             std::string(model::trim(binding.substr(equals + 1))));
    }
}

/// Reports modules that drive the same robot. Without a world, bindings may still separate them.
void check_drivers(const Registry& registry, model::System& system, bool has_world,
                   Diagnostics& diagnostics) {
    const auto drivers = drivers_of(system, registry);
    for (auto d = drivers.begin(); d != drivers.end(); ++d) {
        const auto first =
            std::find_if(drivers.begin(), d, [&](const auto& other) { return other.robot == d->robot; });
        if (first == d) continue;
        diagnostics.add({has_world ? Severity::error : Severity::warning,
                         d->at,
                         fmt::format("two modules drive the robot '{}': those of '{}' and '{}'", d->robot,
                                     model::trim(first->process->name), model::trim(d->process->name)),
                         "each needs a robot of its own: --robot NAME=ROBOT, or <bind> in an experiment, "
                         "binds one of them to another robot",
                         {},
                         {}});
    }
}

/// Reads a system, or a process file as a system of one process.
std::optional<model::System> read_any(const std::string& path, Diagnostics& diagnostics) {
    if (std::filesystem::path(path).extension() != ".iqrProcess") return xml::read_system(path, diagnostics);
    auto file = xml::read_process(path, diagnostics);
    if (!file) return std::nullopt;
    model::System system = model::system_of(*std::move(file));
    model::compute(system, diagnostics);
    return system;
}

std::vector<plugin::File> find_plugins(const RunInput& input, Diagnostics& diagnostics) {
    const char* path = std::getenv("FORAGE_PLUGIN_PATH");
    return plugin::find(input.plugins, path ? path : "", input.system, diagnostics, !input.resumed_files);
}

/// Drops the plugins that a resumed run did not have, and reports those that have changed since.
void keep_those_of(const std::map<std::string, std::string>& run, std::vector<plugin::File>& files,
                   Diagnostics& diagnostics) {
    std::erase_if(files, [&](const plugin::File& file) {
        auto before = run.find(file.path);
        if (before == run.end()) before = run.find(std::filesystem::absolute(file.path).string());
        if (before == run.end()) return true;
        if (before->second == file_digest(file.path)) return false;
        diagnostics.error({}, fmt::format("plugin '{}' has changed since the run began", file.path),
                          "a run can only be resumed with the same files: restore it");
        return true;
    });
}

std::vector<plugin::Plugin> load_plugins(const RunInput& input, plugin::Use use, Diagnostics& diagnostics) {
    auto files = find_plugins(input, diagnostics);
    if (input.resumed_files) keep_those_of(*input.resumed_files, files, diagnostics);
    if (files.empty()) return {};
    return plugin::load(files, use, shipped_types(), diagnostics);
}

}  // namespace

std::string read_input_file(const std::string& path) {
    try {
        return read_file(path);
    } catch (const FileError& e) {
        Diagnostics diagnostics;
        report(e, diagnostics);
        throw InputError(std::move(diagnostics));
    }
}

Registry forage_types() {
    Registry registry;
    add_neurons(registry);
    add_synapses(registry);
    add_modules(registry);
    add_devices(registry);
    registry.add(module_type<replay::Replay>());
    registry.add(bug::gazebo_bug_type());
    return registry;
}

Registry shipped_types() {
    Registry registry = forage_types();
    add_program_types(registry);
    return registry;
}

std::vector<plugin::Plugin> plugins_to_read(const std::vector<std::string>& named, const std::string& system,
                                            Diagnostics& diagnostics) {
    RunInput input;
    input.system = system, input.plugins = named;
    return load_plugins(input, plugin::Use::read, diagnostics);
}

std::vector<std::string> untrusted_folders(const RunInput& input) {
    Diagnostics none;
    std::set<std::string> out;
    for (const auto& file : find_plugins(input, none))
        if (const auto folder = plugin::folder_of(file.path); !file.named && !plugin::is_trusted(folder))
            out.insert(folder);
    return {out.begin(), out.end()};
}

bool check_trusted(const std::vector<std::string>& plugins, Diagnostics& diagnostics) {
    for (const auto& path : plugins) {
        const std::string folder = std::filesystem::is_directory(path) ? path : plugin::folder_of(path);
        if (!plugin::is_trusted(folder))
            diagnostics.error({}, fmt::format("the plugins in '{}' are not trusted", folder),
                              fmt::format("'forage trust {}' trusts them: they are programs", folder));
    }
    return !diagnostics.failed();
}

Registry known_types(const std::vector<plugin::Plugin>& plugins) {
    Registry registry = shipped_types();
    plugin::add(plugins, registry);
    return registry;
}

namespace {

/// The sources with this first system, which is empty when it could not be read.
Sources joined(Sources sources, std::optional<model::System> first, const RunInput& input,
               Diagnostics& diagnostics, plugin::Use use = plugin::Use::run) {
    auto& system = sources.system = std::move(first);
    for (const auto& other : sources.more) {
        if (!system) continue;
        if (other.cycles_per_second != system->cycles_per_second)
            diagnostics.error(other.at,
                              fmt::format("this system runs at {} cycles per second, '{}' at {}",
                                          other.cycles_per_second, input.system, system->cycles_per_second),
                              "systems that run together need the same cyclesPerSecond");
        model::join(*system, other);
    }
    const int errors_before = diagnostics.errors();
    sources.plugins = load_plugins(input, use, diagnostics);
    sources.plugins_failed = diagnostics.errors() > errors_before;
    return sources;
}

/// What a run reads besides its first system.
Sources read_others(const RunInput& input, Diagnostics& diagnostics) {
    diagnostics.lenient = input.lenient;
    Sources out;
    for (const std::string& path : input.more)
        if (auto other = read_any(path, diagnostics)) out.more.push_back(std::move(*other));
    if (!input.world.empty()) out.world = bug::read_world(input.world, diagnostics, {}, input.world_text);
    if (out.world) out.surroundings = std::make_shared<bug::Surroundings>(*out.world);
    out.replay = read_table(input.replay, diagnostics);
    return out;
}

std::optional<model::System> read_first(const RunInput& input, Diagnostics& diagnostics) {
    return input.text.empty() ? read_any(input.system, diagnostics)
                              : xml::parse_system(input.system, input.text, diagnostics);
}

/// Warns of a parameter that a command sets twice. What an experiment sets has a place in its file, and its
/// sweeps set it again on purpose.
template <class Settings>
void warn_of_repeated(const Settings& settings, Diagnostics& diagnostics) {
    std::set<std::string_view> names;
    for (const auto& setting : settings) {
        if (setting.at.file) continue;
        const auto name = model::trim(std::string_view(setting.text).substr(0, setting.text.find('=')));
        if (!names.insert(name).second)
            diagnostics.warning({}, fmt::format("--set: '{}' is set more than once", name),
                                "the last one counts");
    }
}

}  // namespace

Sources with_first_system(Sources sources, const RunInput& input, Diagnostics& diagnostics) {
    auto first = read_first(input, diagnostics);
    return joined(std::move(sources), std::move(first), input, diagnostics);
}

Sources read_sources(const RunInput& input, Diagnostics& diagnostics) {
    auto others = read_others(input, diagnostics);  // the order of the messages is that of reading
    return with_first_system(std::move(others), input, diagnostics);
}

Sources read_sources(const RunInput& input, model::System first, Diagnostics& diagnostics) {
    return joined(read_others(input, diagnostics), std::move(first), input, diagnostics);
}

std::optional<Loaded> assemble(const Sources& sources, const RunInput& input, Diagnostics& diagnostics) {
    Loaded out;
    if (sources.system) out.system = *sources.system;
    if (sources.replay) play(*sources.replay, out.system);
    out.registry = shipped_types();
    plugin::add(sources.plugins, out.registry);
    for (const auto& p : sources.plugins)
        if (p.loaded) out.plugins.push_back(p.path);
    if (sources.system && !sources.plugins_failed) {
        equations::add_types(out.system, out.registry, diagnostics);
        bind_robots(input.robots, out.registry, out.system, diagnostics);
        warn_of_repeated(input.settings, diagnostics);
        for (const auto& setting : input.settings)
            model::set(out.system, out.registry, setting.text, diagnostics, setting.at, setting.value_at);
        Diagnostics reported;  // states may begin with constants that have changed
        if (!input.settings.empty()) equations::add_types(out.system, out.registry, reported);
    }
    if (sources.world) {  // after the settings, which may change the rate
        bug::WorldOptions options;
        options.seed = input.seed;
        options.cycles_per_second = model::cycles_per_second(out.system);
        options.real_time_factor = input.real_time_factor;
        options.noise = input.noise;
        options.sensor_rates = input.sensor_rates;
        options.latency = input.latency;
        options.game = input.game;
        options.surroundings = sources.surroundings;
        out.world = bug::World::make(*sources.world, options, diagnostics);
    }
    if (sources.system && !sources.plugins_failed) {
        check_drivers(out.registry, out.system, out.world != nullptr, diagnostics);
        if (diagnostics.failed())
            model::validate(out.system, out.registry, diagnostics,
                            out.world.get());  // reports all mistakes at once
    }
    if (diagnostics.failed()) return std::nullopt;
    return out;
}

std::optional<Loaded> load(const RunInput& input, Diagnostics& diagnostics) {
    auto others = read_others(input, diagnostics);
    auto first = read_first(input, diagnostics);
    return assemble(joined(std::move(others), std::move(first), input, diagnostics, plugin::Use::read), input,
                    diagnostics);
}

std::optional<engine::Simulation> compile(const std::optional<Loaded>& loaded, std::uint64_t seed,
                                          Diagnostics& diagnostics) {
    if (!loaded) return std::nullopt;
    auto layout = engine::make_layout(loaded->system, loaded->registry, diagnostics, loaded->world.get());
    if (!layout) return std::nullopt;
    return engine::Simulation::build(loaded->system, std::move(*layout), engine::Demand::everything(),
                                     {.seed = seed}, diagnostics);
}

InputFiles input_files(const RunSpec& spec, const Sources& sources) {
    InputFiles out = files_of_system(sources);
    if (!spec.input.text.empty()) out.erase(spec.input.system);  // there is no such file
    const auto read = [&](const std::string& path) {
        if (!path.empty()) out[path] = file_digest(path);
    };
    if (sources.world) out.merge(files_of_world(sources)), read(spec.input.world);
    read(spec.input.replay);
    for (const auto& m : spec.manipulations) read(m.patterns.text), read(m.table.text);
    return out;
}

std::string source_digests(const RunInput& input, const Sources& sources) {
    std::string system = without_paths(files_of_system(sources));
    for (const auto& [name, version] : program_types_of(*sources.system)) system += name + version;
    for (const auto& other : sources.more)  // their order matters
        system += " " + without_paths(system_files(other));
    if (!sources.world) return system;
    return fmt::format("{} {} {}", system, file_digest(input.world), without_paths(files_of_world(sources)));
}

}  // namespace forage
