#include "tools/api/forage/forage.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/plugin/plugin.h"
#include "core/plugin/search.h"
#include "core/xml/reader.h"
#include "modules/modules.h"
#include "modules/replay/replay.h"
#include "neurons/neurons.h"
#include "synapses/synapses.h"

namespace forage {
namespace {

[[noreturn]] void refuse(const Diagnostics& diagnostics) { throw InputError(format(diagnostics)); }

Registry types(const std::vector<std::string>& plugins, Diagnostics& diagnostics) {
    Registry out;
    add_neurons(out);
    add_synapses(out);
    add_modules(out);
    out.add(module_type<replay::Replay>());
    plugin::add(plugin::load(plugin::find(plugins, {}, {}, diagnostics), out, diagnostics), out);
    return out;
}

int named(std::string_view what, std::string_view name, const std::vector<std::string>& known) {
    const auto found = std::find(known.begin(), known.end(), name);
    if (found != known.end()) return static_cast<int>(found - known.begin());
    const std::string hint = suggest(name, known);
    throw std::invalid_argument(
        fmt::format("there is no {} '{}'{}{}", what, name, hint.empty() ? "" : "; ", hint));
}

}  // namespace

Model::Model(model::System system, Registry types, engine::Simulation simulation)
    : Simulation(std::move(simulation)), system_(std::move(system)), types_(std::move(types)) {}

int Model::group(std::string_view path) const {
    std::vector<std::string> known;
    for (const auto& g : layout().groups) known.push_back(g.path);
    return named("group", path, known);
}

int Model::state(int group, std::string_view name) const {
    std::vector<std::string> known;
    const NeuronType& type = layout().groups.at(group).type;
    for (const auto& s : type.states) known.push_back(s.name);
    return named(fmt::format("state of {}", type.name), name, known);
}

void Model::set(std::string_view assignment) {
    Diagnostics diagnostics;
    const auto change = model::parse_assignment(system_, types_, assignment, "set", diagnostics);
    if (change) check({&*change, 1}, diagnostics);
    if (diagnostics.failed()) refuse(diagnostics);
    Simulation::set(*change);
}

Registry types(const std::vector<std::string>& plugins) {
    Diagnostics diagnostics;
    Registry out = types(plugins, diagnostics);
    if (diagnostics.failed()) refuse(diagnostics);
    return out;
}

Model build(model::System system, Registry types, const LoadOptions& options) {
    Diagnostics diagnostics;
    diagnostics.lenient = options.lenient;
    engine::Simulation::Options wanted;
    wanted.seed = options.seed, wanted.threads = options.threads;
    auto simulation =
        engine::Simulation::build(system, types, engine::Demand::everything(), wanted, diagnostics);
    if (!simulation) refuse(diagnostics);
    simulation->start();
    return {std::move(system), std::move(types), std::move(*simulation)};
}

Model load(const std::string& path, const LoadOptions& options) {
    Diagnostics diagnostics;
    diagnostics.lenient = options.lenient;
    auto system = xml::read_system(path, diagnostics);
    Registry registry = types(options.plugins, diagnostics);
    if (!system) refuse(diagnostics);
    if (!diagnostics.failed()) return build(std::move(*system), std::move(registry), options);
    engine::Simulation::build(*system, registry, {}, {}, diagnostics);  // says what else is wrong
    refuse(diagnostics);
}

}  // namespace forage
