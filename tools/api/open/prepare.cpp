#include "tools/api/open/prepare.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "bug_interface/versions.h"
#include "core/base/cores.h"
#include "core/base/separated.h"
#include "core/model/lookup.h"
#include "core/run/checkpoint_file.h"
#include "modules/replay/replay.h"
#include "tools/api/open/run_observers.h"

namespace forage {
namespace {

constexpr double default_seconds = 60;  ///< length of a run, s of the world

/// Reports the rows of a --replay table that no moduleReplay of the system plays.
void check_replay(const DriveTable& table, const model::System& system, Diagnostics& diagnostics) {
    const model::GroupIndex groups(system);
    std::vector<std::pair<std::string, ModulePorts::Group>> outputs;  // with the process of the module
    std::vector<std::string> names;
    for (const auto& p : system.processes) {
        if (!p.module || !p.module_enabled || p.module->type != "moduleReplay") continue;
        for (const auto& r : p.module->outputs)
            if (const auto entry = groups.find(r.target); entry.group) {
                const auto process = std::string(model::trim(p.name));
                outputs.push_back({process,
                                   {r.name,
                                    std::string(model::trim(entry.process->name)) + "/" +
                                        std::string(model::trim(entry.group->name)),
                                    {}}});
                names.push_back(process + "," + r.name);
            }
    }
    if (outputs.empty()) {
        diagnostics.error({},
                          fmt::format("--replay '{}': no process has an enabled moduleReplay to play it",
                                      table.file()->path),
                          "--clamp overwrites the activity of any group");
        return;
    }
    std::set<std::string> reported;
    for (const auto& row : table.rows()) {
        const bool played = std::ranges::any_of(
            outputs, [&](const auto& o) { return replay::plays(row, o.first, o.second); });
        const std::string target = row.process + "," + row.target;
        if (!played && reported.insert(target).second)
            diagnostics.error({table.file(), row.line, row.column},
                              fmt::format("no moduleReplay plays '{}'", target), suggest(target, names));
    }
}

/// Creates and locks the directory for results.
bool open_directory(const std::string& directory, DirectoryHold& hold, Diagnostics& diagnostics) {
    const char* hint = "choose another directory for the results with -o";
    try {
        make_directory(directory);
        hint = held_hint;
        hold = DirectoryHold(directory);
        return true;
    } catch (const std::exception& e) {
        diagnostics.error({}, e.what(), hint);
        return false;
    }
}

/// Notes what the run reads, for run.json and for a bundle.
void note_inputs(PreparedRun& run, const Sources& sources) {
    run.inputs = input_files(run.spec, sources);
    for (const auto& path : module_files(run.run.system(), run.run.registry(), run.schedule->assignments())) {
        if (std::error_code none; !std::filesystem::is_regular_file(path, none)) continue;
        run.inputs[path] = file_digest(path);
        if (!run.spec.bundle.empty()) run.module_texts[path] = read_input_file(path);
    }
}

}  // namespace

std::optional<PreparedRun> prepare(const Sources& sources, const RunSpec& given, Diagnostics& diagnostics) {
    RunSpec spec = given;
    auto& length = spec.length;
    if (!length.cycles && !length.trials && !length.seconds) length.seconds = default_seconds;
    auto loaded = assemble(sources, spec.input, diagnostics);
    if (!loaded) return std::nullopt;
    if (sources.replay) check_replay(*sources.replay, loaded->system, diagnostics);
    bug::World* world = loaded->world.get();
    auto run = Run::make(std::move(loaded->system), std::move(loaded->registry), std::move(loaded->world),
                         {.seed = spec.input.seed,
                          .threads = std::min(spec.threads, cores()),
                          .compute_everything = false,
                          .check_finite = spec.on_nan != OnNan::ignore,
                          .directory = spec.directory},
                         diagnostics);
    if (!run) return std::nullopt;
    auto stop = StopCondition::make(length, *run, diagnostics);
    stop.declare(run->demand());
    if (spec.checkpoint_every && spec.directory.empty())
        diagnostics.error({}, "--checkpoint-every needs a directory to write to",
                          "leave out -o '' or name one");
    if (!spec.bundle.empty() && spec.directory.empty())
        diagnostics.error({}, "--bundle needs a directory of results", "leave out -o '' or name one");
    if (!spec.bundle.empty()) check_output(spec.bundle, "paper.zip", diagnostics);
    if (spec.checkpoint_every || spec.digest)
        check_checkpoints(run->layout(), spec.checkpoint_every ? "--checkpoint-every" : "--hash",
                          diagnostics);
    if (spec.digest) run->demand().read_everything();
    try {
        PreparedRun prepared{.spec = std::move(spec),
                             .run = std::move(*run),
                             .stop = std::move(stop),
                             .plugins = std::move(loaded->plugins),
                             .libraries = bug::library_versions()};
        add_observers(prepared, world, diagnostics);
        if (!prepared.run.start(diagnostics)) return std::nullopt;
        const std::string& directory = prepared.spec.directory;
        if (!directory.empty() && !open_directory(directory, prepared.hold, diagnostics)) return std::nullopt;
        if (!prepared.spec.command.empty()) note_inputs(prepared, sources);
        add_checkpoints(prepared, sources);
        return prepared;
    } catch (const std::exception& e) {
        diagnostics.error({}, e.what());
        return std::nullopt;
    }
}

void clear_directory(const RunSpec& spec, Diagnostics& diagnostics) {
    const std::string& directory = spec.directory;
    if (has_checkpoint(directory) && !spec.discard_checkpoint)
        return diagnostics.error(
            {}, fmt::format("'{}' holds the checkpoint of a run that has not finished", directory),
            fmt::format("'forage resume {}' continues that run; --discard-checkpoint gives it up, and -o "
                        "names another directory",
                        directory));
    remove_checkpoints(directory);
    const auto removed = remove_unfinished(directory);
    if (!removed.empty())
        diagnostics.warning(
            {}, fmt::format("removed from '{}', as a run was killed before it finished them: {}", directory,
                            separated(removed, ", ")));
}

}  // namespace forage
