#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <set>

#include <fmt/format.h>
#include <forage/system.h>
#include <unistd.h>

#include "core/base/output_files.h"
#include "core/base/print.h"
#include "core/base/separated.h"
#include "core/base/sequence.h"
#include "core/model/arrays.h"
#include "core/model/build.h"
#include "core/model/edit.h"
#include "core/model/lookup.h"
#include "core/xml/reader.h"
#include "core/xml/writer.h"
#include "tools/forage/commands.h"
#include "tools/forage/options.h"

namespace forage::tool {
namespace {

struct ConvertOptions {
    std::string input, output;         ///< .iqr or .iqrProcess files
    std::vector<std::string> imports;  ///< process files to add
    /// Name or id of the process to write as a file of its own; empty: the whole system.
    std::string extract;
    std::string as_plugin;  ///< name of a declared type to write as the source of a plugin; empty: none
    std::vector<std::string> plugins;
    bool terse = false, full = false;
    bool original = false;  ///< whether to write everything that the original requires
    bool embed = false, lenient = false;
};

namespace fs = std::filesystem;

bool is_standard_output(const std::string& path) { return path == "-"; }
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
                        separated(names_of(file.process.ports), ", ")));
}

/// Chooses the short or the long form of what both can say.
void rewrite(const ConvertOptions& o, std::span<model::Process> processes,
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

/// Warns that relative paths in parameters stay as they are when the types are those of plugins that are not
/// loaded.
void warn_of_paths(const ConvertOptions& o, const model::System& system, const Registry& types,
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

std::string process_id(const model::System& system, const std::string& wanted, Diagnostics& diagnostics) {
    const auto found = model::items_named(system.processes, wanted);
    if (!found.empty()) return system.processes[found.front()].id;
    const auto names =
        collected(system.processes, [](const auto& p) { return std::string(model::trim(p.name)); });
    diagnostics.error({}, fmt::format("--extract: there is no process '{}'", wanted), suggest(wanted, names));
    return {};
}

/// The text of the file to write, and `notes` for users. They have no meaning when there are errors.
std::string converted(const ConvertOptions& o, std::string& notes, Diagnostics& diagnostics) {
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
    if (!o.as_plugin.empty()) return plugin_source(read_system(o.input, o.plugins), o.as_plugin);
    auto system = xml::read_system(o.input, diagnostics);
    const auto plugins = plugins_to_read(o.plugins, o.input, diagnostics);  // their parameters may name files
    if (!system) return {};
    for (const auto& path : o.imports)
        if (auto file = xml::read_process(path, diagnostics); file && !diagnostics.failed()) try {
                notes += about_import(*system, model::import_process(*system, std::move(*file)));
            } catch (const std::invalid_argument& e) {
                diagnostics.error({std::make_shared<SourceFile>(SourceFile{path, {}})}, e.what());
            }
    if (o.embed) model::embed_links(*system);
    if (o.original) model::refuse_extensions(*system, diagnostics), model::make_original(*system);
    if (!to_process && !o.extract.empty()) {
        diagnostics.error({},
                          fmt::format("--extract writes a process file, '{}' would be a system", o.output),
                          "name it .iqrProcess");
        return {};
    }
    if (!to_process) {
        const Registry types = known_types(plugins);
        if (!is_standard_output(o.output)) {  // of which the folder is not known
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
    const std::string id = process_id(*system, o.extract, diagnostics);
    if (id.empty()) return {};
    auto file = model::extract_process(*system, id);
    rewrite(o, {&file.process, 1}, file.connections);
    warn_of_loss(*system, file, diagnostics);
    return xml::write_process(file);
}

int convert(const ConvertOptions& options) {
    Diagnostics diagnostics;
    diagnostics.lenient = options.lenient;
    const bool prints = is_standard_output(options.output);
    if (!prints) check_output(options.output, "copy.iqr", diagnostics);
    std::string notes;
    std::string text;
    try {
        text = converted(options, notes, diagnostics);
    } catch (const InputError& e) {
        print(stderr, "{}", e.what());
        return bad_input;
    }
    print(stderr, "{}", format(diagnostics));
    if (diagnostics.failed()) return bad_input;
    if (!prints) write_file(options.output, text);
    if (prints && isatty(STDOUT_FILENO))
        print("{}", text);  // which escapes what a terminal would carry out
    else if (prints)
        std::fputs(text.c_str(), stdout);
    print(prints ? stderr : stdout, "{}", notes);
    return fine;
}

}  // namespace

void add_convert(Program& program) {
    auto& o = program.options<ConvertOptions>();
    auto& command =
        program.add("convert", "Read a system or process file and write it in the standard layout",
                    [&o] { return convert(o); });
    command.footer(
        "Example:\n"
        "  forage convert systems/reactive_foraging.iqr bug.iqrProcess --extract Bug\n"
        "  forage convert systems/models/oja.iqr oja.cpp --as-plugin oja");
    add_value(command, "IN", o.input, "FILE", "File to read (.iqr or .iqrProcess)")->required();
    add_value(command, "OUT", o.output, "FILE",
              "File to write (.iqr or .iqrProcess; .cpp with --as-plugin); may be the same, or - to print it")
        ->required()
        ->check(named("file"));
    repeated(command.add_option("--import", o.imports,
                                "Add a copy of a process from an .iqrProcess file; may be repeated"))
        ->option_text("FILE");
    add_value(command, "--extract", o.extract, "PROCESS",
              "Write this process alone, with the connections among its groups");
    add_value(command, "--as-plugin", o.as_plugin, "TYPE",
              "Write this type of the system as the source of a plugin that computes the same");
    add_plugins(command, o.plugins);
    command.add_flag("--embed", o.embed, "Write the content of linked processes instead of links");
    auto* terse = command.add_flag(
        "--terse", o.terse,
        "Leave out what is the same in most systems, and write sizes and weights as attributes");
    command.add_flag("--full", o.full, "Write what the file leaves out, and sizes and weights as elements")
        ->excludes(terse);
    command.add_flag("--original", o.original,
                     "Write plain numbers instead of constants and formulas, and what the file leaves out "
                     "and the original iqr requires: patterns, arborizations, "
                     "functions, places in the diagram");
    command.add_flag("--lenient", o.lenient,
                     "Unknown elements and attributes are warnings, and are not written");
}

}  // namespace forage::tool
