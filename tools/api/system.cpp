#include <filesystem>

#include <fmt/format.h>
#include <forage/system.h>

#include "core/base/output_files.h"
#include "core/equations/declared_types.h"
#include "core/equations/plugin_source.h"
#include "core/model/lookup.h"
#include "core/model/validate.h"
#include "core/xml/reader.h"
#include "core/xml/writer.h"
#include "tools/api/describe/system_description.h"
#include "tools/api/open/saved_run.h"
#include "tools/api/open/sources.h"
#include "tools/plot/structure.h"

namespace forage {
namespace {

SystemFile make_file(std::optional<model::System> model, std::string path, std::vector<std::string> plugins,
                     Diagnostics diagnostics, Diagnostics* warnings) {
    throw_errors(diagnostics);
    SystemFile out{std::move(*model), std::move(path), std::move(plugins), nullptr};
    Registry types = known_types(plugins_to_read(out.plugins, out.path, diagnostics));
    equations::add_types(out.model, types, diagnostics);
    out.types = std::make_shared<Registry>(std::move(types));
    throw_errors(diagnostics);
    append(warnings, diagnostics);
    return out;
}

void declare(SystemFile& file, std::vector<model::TypeDeclaration> model::System::*types,
             model::TypeDeclaration type) {
    model::System model = file.model;
    (model.*types).push_back(std::move(type));
    Registry registry = *file.types;
    Diagnostics diagnostics;
    equations::add_types(model, registry, diagnostics);
    throw_errors(diagnostics);
    file.model = std::move(model), file.types = std::make_shared<Registry>(std::move(registry));
}

}  // namespace

void declare_neuron_type(SystemFile& file, model::TypeDeclaration type) {
    declare(file, &model::System::neuron_types, std::move(type));
}

void declare_synapse_type(SystemFile& file, model::TypeDeclaration type) {
    declare(file, &model::System::synapse_types, std::move(type));
}

SystemFile new_system(const std::string& name, std::vector<std::string> plugins) {
    model::System model;
    model.id = "system", model.name = name;
    return make_file(std::move(model), name + ".iqr", std::move(plugins), {}, nullptr);
}

SystemFile read_system(const std::string& path, std::vector<std::string> plugins, bool lenient,
                       Diagnostics* warnings) {
    Diagnostics diagnostics;
    diagnostics.lenient = lenient;
    auto model = xml::read_system(path, diagnostics);
    return make_file(std::move(model), path, std::move(plugins), std::move(diagnostics), warnings);
}

SystemFile parse_system(const std::string& text, const std::string& path, std::vector<std::string> plugins,
                        Diagnostics* warnings) {
    Diagnostics diagnostics;
    auto model = xml::parse_system(path, text, diagnostics);
    return make_file(std::move(model), path, std::move(plugins), std::move(diagnostics), warnings);
}

std::string plugin_source(const SystemFile& file, const std::string& type) {
    std::vector<std::string> names;
    Diagnostics diagnostics;
    for (const auto* all : {&file.model.neuron_types, &file.model.synapse_types})
        for (const auto& d : *all) try {
                names.push_back(d.name);
                if (d.name == type)
                    return equations::plugin_source(d, all == &file.model.synapse_types, *file.types);
            } catch (const FormulaError& e) {
                diagnostics.error(equations::place(d, e.at), e.what(), e.hint);
            }
    throw_errors(diagnostics);
    throw InputError(fmt::format("the system declares no type '{}'", type), suggest(type, names));
}

std::string text_of(const SystemFile& file) { return xml::write_system(file.model); }

void save(SystemFile& file, const std::string& path, bool original) {
    model::System moved = file.model;
    model::move_files(moved, file.path, path, *file.types);
    if (original) {
        Diagnostics diagnostics;
        model::make_original(moved, diagnostics);
        throw_errors(diagnostics);
    }
    write_file(path, xml::write_system(moved));
    file.model = std::move(moved), file.path = path;
}

void save_process(const SystemFile& file, const std::string& id, const std::string& path) {
    write_file(path, xml::write_process(model::extract_process(file.model, id)));
}

std::string import_process(SystemFile& file, const std::string& path) {
    Diagnostics diagnostics;
    auto process = checked(diagnostics, xml::read_process(path, diagnostics));
    return model::import_process(file.model, std::move(*process));
}

std::optional<engine::Simulation> compile(const SystemFile& file, const std::string& world,
                                          std::uint64_t seed, Diagnostics& diagnostics) {
    RunInput input;
    input.system = file.path, input.text = text_of(file), input.world = world, input.plugins = file.plugins;
    return compile(load(input, diagnostics), seed, diagnostics);
}

Run open(const SystemFile& file, const OpenOptions& options, Diagnostics* warnings) {
    OpenOptions all = options;
    all.plugins.insert(all.plugins.end(), file.plugins.begin(), file.plugins.end());
    return open(file.path, text_of(file), all, warnings);
}

std::string diagram(const SystemFile& file, const std::string& process, const std::string& format) {
    Diagnostics diagnostics;
    const auto wanted = plot::format_of("x." + format);
    if (!wanted) diagnostics.error({}, "'" + format + "' is not a format of pictures", "png, svg or pdf");
    const auto spec =
        plot::parse_plot(process.empty() ? "diagram" : "diagram:" + process, "diagram", diagnostics);
    if (spec) plot::check_structure(*spec, file.model, "diagram", diagnostics);
    throw_errors(diagnostics);
    const std::string name = std::filesystem::path(file.path).filename().string();
    return plot::render(plot::structure_plot(*spec, file.model, *file.types, nullptr, 1, name), *wanted);
}

std::string describe(const SystemFile& file, const std::string& format, std::uint64_t seed) {
    Diagnostics diagnostics;
    const auto compiled = compile(file, {}, seed, diagnostics);
    throw_errors(diagnostics);
    return in_format(describe(file.model, *file.types, &*compiled), format);
}

SynapseTable synapses(const SystemFile& file, const std::string& id, std::uint64_t seed) {
    Diagnostics diagnostics;
    if (std::ranges::find(file.model.connections, id, &model::Connection::id) == file.model.connections.end())
        throw InputError(fmt::format("there is no connection with the id '{}'", id));
    // A system that a program has built has not read its arrays, and its mistakes have places in its text.
    Diagnostics found;
    model::validate(file.model, *file.types, found);
    std::optional<model::System> read;
    if (found.failed()) read = xml::parse_system(file.path, text_of(file), diagnostics);
    throw_errors(diagnostics);
    const model::System& system = read ? *read : file.model;
    const auto it = std::ranges::find(system.connections, id, &model::Connection::id);
    const auto* type = file.types->synapse(model::synapse_of(*it).type);
    std::optional<engine::Simulation> simulation;  // weights that are learned begin as states
    if (type && !type->has_gain) simulation = compile(file, {}, seed, diagnostics);
    throw_errors(diagnostics);
    auto [list, strength] =
        plot::synapses_of(*it, system, *file.types, simulation ? &*simulation : nullptr, seed, diagnostics);
    throw_errors(diagnostics);
    return {std::move(list.pre), std::move(list.post), std::move(list.distance), std::move(list.delay),
            std::move(strength)};
}

}  // namespace forage
