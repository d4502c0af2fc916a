#include "tools/api/edit/convert.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <span>

#include <fmt/format.h>

#include "core/base/separated.h"
#include "core/base/sequence.h"
#include "core/model/build.h"
#include "core/model/edit.h"
#include "core/model/find_one.h"
#include "core/model/lookup.h"
#include "core/xml/reader.h"
#include "core/xml/writer.h"
#include "tools/api/open/sources.h"

namespace forage {
namespace {

namespace fs = std::filesystem;

bool is_process_file(const std::string& path) { return fs::path(path).extension() == ".iqrProcess"; }

/// Warns about the connections of a process to groups outside it, which are not extracted.
void warn_of_loss(const model::System& system, const model::ProcessFile& file, Diagnostics& diagnostics) {
    std::set<std::string> groups;
    for (const auto& g : file.process.groups) groups.insert(g.id);
    const auto lost = std::ranges::count_if(system.connections, [&](const auto& c) {
        return groups.contains(c.source) != groups.contains(c.target);
    });
    if (lost)
        diagnostics.warning(
            {}, fmt::format("--extract: connections from or to other processes are not written: {}", lost),
            fmt::format("a system that uses the file connects its ports: {}",
                        separated(forage::names_of(file.process.ports), ", ")));
}

/// Chooses the short or the long form of what both can say.
void rewrite(const Conversion& o, std::span<model::Process> processes,
             std::span<model::Connection> connections) {
    if (o.terse) model::shorten(processes, connections);
    if (o.full) model::complete(processes, connections);
}

/// Says that an imported process is not connected yet, and names the ids that a connection needs.
std::string about_import(model::System& system, const std::string& id) {
    const model::Process& process = *model::find_process(system, id);
    const auto groups = collected(
        process.groups, [](const auto& g) { return fmt::format("{} ({})", g.id, model::trim(g.name)); });
    return fmt::format(
        "imported '{}'; nothing connects it with the other processes yet\n"
        "  write each <Connection> that it needs; the ids of its groups are {}\n",
        model::trim(process.name), separated(groups, ", "));
}

/// Warns that relative paths in parameters are unchanged when the types are those of plugins that are not
/// loaded.
void warn_of_paths(const Conversion& o, const model::System& system, const Registry& types,
                   Diagnostics& diagnostics) {
    const auto folder = [](const std::string& file) {
        return fs::absolute(file).lexically_normal().parent_path();
    };
    if (types.unloaded.empty() || folder(o.input) == folder(o.output)) return;
    const auto is_unknown = [&](const model::Process& p) {
        return (p.module && !types.module(p.module->type)) ||
               std::ranges::any_of(p.groups, [&](const auto& g) { return !types.neuron(g.neuron.type); });
    };
    if (std::ranges::any_of(system.processes, is_unknown))
        diagnostics.warning({},
                            fmt::format("the plugins in '{}' are not loaded: relative paths in parameters of "
                                        "their types are not changed",
                                        types.unloaded.front().folder),
                            types.unloaded.front().hint);
}

}  // namespace

std::string converted(const Conversion& o, std::string& notes, Diagnostics& diagnostics) {
    const bool to_process = is_process_file(o.output);
    if (is_process_file(o.input)) {
        auto file = xml::read_process(o.input, diagnostics);
        if (!file) return {};
        if (!to_process || !o.imports.empty() || !o.extract.empty() || o.embed) {
            diagnostics.error({}, fmt::format("'{}' is a process file", o.input),
                              "it can be written as one (OUT.iqrProcess), or imported into a system: forage "
                              "convert SYSTEM.iqr OUT.iqr --import FILE");
            return {};
        }
        if (o.original) model::make_original(*file, diagnostics);
        rewrite(o, {&file->process, 1}, file->connections);
        return xml::write_process(*file);
    }
    auto system = xml::read_system(o.input, diagnostics);
    // The types of plugins say which parameters name files, whose paths change with the folder.
    const auto plugins = plugins_to_read(o.plugins, o.input, diagnostics);
    if (!system) return {};
    for (const auto& path : o.imports)
        if (auto file = xml::read_process(path, diagnostics); file && !diagnostics.failed()) try {
                notes += about_import(*system, model::import_process(*system, std::move(*file)));
            } catch (const std::invalid_argument& e) {
                diagnostics.error({std::make_shared<SourceFile>(SourceFile{path, {}})}, e.what());
            }
    if (o.embed) model::embed_links(*system);
    if (o.original) model::make_original(*system, diagnostics);
    if (!to_process && !o.extract.empty()) {
        diagnostics.error({},
                          fmt::format("--extract writes a process file, '{}' would be a system", o.output),
                          "name it .iqrProcess");
        return {};
    }
    if (!to_process) {
        const Registry types = known_types(plugins);
        if (o.output != standard_output) {
            warn_of_paths(o, *system, types, diagnostics);
            model::move_files(*system, o.input, o.output, types);
        }
        rewrite(o, system->processes, system->connections);
        return xml::write_system(*system);
    }
    if (o.extract.empty()) {
        diagnostics.error({},
                          fmt::format("'{}' is a system, '{}' would be a process file", o.input, o.output),
                          "name the process to write with --extract");
        return {};
    }
    const auto process = model::find_one(system->processes, "process", o.extract,
                                         [&](const std::string& message, const std::string& hint) {
                                             diagnostics.error({}, "--extract: " + message, hint);
                                         });
    if (!process) return {};
    auto file = model::extract_process(*system, system->processes[static_cast<std::size_t>(*process)].id);
    rewrite(o, {&file.process, 1}, file.connections);
    warn_of_loss(*system, file, diagnostics);
    return xml::write_process(file);
}

}  // namespace forage
