#include "core/engine/parameters.h"

#include <algorithm>
#include <map>
#include <memory>

#include <fmt/format.h>

#include "core/base/named_file.h"
#include "core/engine/run_error.h"
#include "core/model/changes.h"
#include "core/model/constants.h"

namespace forage::engine {
namespace {

using model::Assignment;

/// The number of the item whose parameter is set; -1 for a module that is disabled.
int number_of(const Layout& layout, const Assignment& a) {
    const auto number = [&](const auto& items, auto id) {
        const auto it =
            std::find_if(items.begin(), items.end(), [&](const auto& i) { return i.*id == a.id; });
        return it == items.end() ? -1 : static_cast<int>(it - items.begin());
    };
    switch (a.owner) {
        case Assignment::Owner::group:
            return number(layout.groups, &Layout::Group::id);
        case Assignment::Owner::connection:
            return number(layout.connections, &Layout::Connection::id);
        case Assignment::Owner::process:
        case Assignment::Owner::constant:
            break;
    }
    return number(layout.modules, &Layout::Module::process_id);
}

struct Refusal {
    std::string why, hint;
};

/// Why a parameter cannot change while the system runs; empty when it can.
std::optional<Refusal> refusal(const Layout& layout, const Assignment& a) {
    const std::string before = "set it before the run";
    if (!a.parameter) return Refusal{"a module cannot be switched on or off while the system runs", before};
    if (number_of(layout, a) < 0) return Refusal{"the module is disabled", "enable it: enableModule=true"};
    if (a.parameter->at_start)
        return Refusal{fmt::format("'{}' is read at start only", a.parameter->name), before};
    return std::nullopt;
}

/// Copies of objects with parameters, by their number.
template <class Instance>
class Copies {
  public:
    explicit Copies(const Layout& layout) : layout_(layout) {}
    template <class Type>
    Instance& of(int number, const Type& type, Instance& original) {
        auto& copy = copies_[number];
        if (!copy) {
            copy = type.make();
            for (const auto& p : type.parameters) p.set(copy->parameters(), p.get(original.parameters()));
            if constexpr (requires { type.set_dt; })
                if (type.set_dt) type.set_dt(copy->parameters(), layout_.seconds_per_cycle);
        }
        return *copy;
    }

  private:
    const Layout& layout_;
    std::map<int, std::unique_ptr<Instance>> copies_;
};

}  // namespace

LiveConstants::LiveConstants(const model::System& system, const Layout& layout) : system_(system) {
    const auto types = std::make_shared<Registry>();
    const auto add = [&](const auto& type, const auto& known) {
        if (!known.contains(type.name)) types->add(type);
    };
    for (const auto& g : layout.groups) add(g.type, types->neurons());
    for (const auto& m : layout.modules) add(m.type, types->modules());
    for (const auto& c : layout.connections) add(c.type, types->synapses());
    types_ = types;
}

std::optional<std::vector<Assignment>> LiveConstants::changes(const Layout& layout,
                                                              const Assignment& change) const {
    auto out = model::parameter_changes(system_, model::with(system_, change), *types_);
    if (out) std::erase_if(*out, [&](const Assignment& a) { return number_of(layout, a) < 0; });  // disabled
    return out;
}

void LiveConstants::checkpoint(Archive& archive) {
    for (auto& c : system_.constants) archive(c.value);
    for (auto& p : system_.processes)
        for (auto& c : p.constants) archive(c.value);
    if (archive.loading()) model::compute(system_);
}

std::vector<Assignment> expanded(LiveConstants constants, const Layout& layout,
                                 std::span<const Assignment> changes, Diagnostics& diagnostics) {
    std::vector<Assignment> out;
    for (const auto& change : changes) {
        if (!is_constant(change)) {
            out.push_back(change);
            continue;
        }
        const auto found = constants.changes(layout, change);
        if (!found) {
            diagnostics.error(change.at,
                              fmt::format("'{}': more than parameters depends on this constant", change.text),
                              "set it before the run");
            continue;
        }
        for (auto a : *found) a.at = change.at, out.push_back(std::move(a));
        constants.set(change);
    }
    return out;
}

void check_changes(const Plan& plan, const State& state, std::span<const Assignment> changes,
                   Diagnostics& diagnostics) {
    Copies<NeuronInstance> neurons(plan.layout);
    Copies<SynapseInstance> synapses(plan.layout);
    Copies<ModuleInstance> modules(plan.layout);
    const auto pass_on = [&](const Assignment& a, const Diagnostics& found) {
        for (Diagnostic d : found.all()) {
            d.where = a.at;
            d.message = fmt::format("'{}': {}", a.text, d.message);
            diagnostics.add(std::move(d));
        }
    };
    const auto change_cells = [&](const Assignment& a, const auto& type, auto& copy) {
        a.parameter->set(copy.parameters(), a.value);
        Diagnostics found;
        if (type.check) type.check(copy.parameters(), found);
        pass_on(a, found);
    };
    for (const auto& a : changes) {
        if (const auto refused = refusal(plan.layout, a)) {
            diagnostics.error(a.at, fmt::format("'{}': {}", a.text, refused->why), refused->hint);
            continue;
        }
        const int i = number_of(plan.layout, a);
        if (a.owner == Assignment::Owner::group) {
            const auto& type = plan.layout.groups[i].type;
            change_cells(a, type, neurons.of(i, type, *state.groups[i].neuron));
        } else if (a.owner == Assignment::Owner::connection) {
            const auto& type = plan.layout.connections[i].type;
            change_cells(a, type, synapses.of(i, type, *state.connections[i].synapse));
        } else {
            auto& copy = modules.of(i, plan.layout.modules[i].type, *state.modules[i].module);
            a.parameter->set(copy.parameters(), a.value);
            Diagnostics found;
            try {
                copy.check(state.modules[i].ports, found);
            } catch (const FileError& e) {
                report(e, diagnostics);
            }
            pass_on(a, found);
        }
    }
}

void set_parameter(const Plan& plan, State& state, Cycle& cycle, const Assignment& a) {
    if (const auto refused = refusal(plan.layout, a))
        throw RunError(fmt::format("'{}': {}", a.text, refused->why));
    const int i = number_of(plan.layout, a);
    if (a.owner == Assignment::Owner::group) {
        a.parameter->set(state.groups[i].neuron->parameters(), a.value);
        cycle.invalidate(i);
    } else if (a.owner == Assignment::Owner::connection) {
        a.parameter->set(state.connections[i].synapse->parameters(), a.value);
        if (plan.connections[i].kernel) state.connections[i].changed = true;
    } else {
        a.parameter->set(state.modules[i].module->parameters(), a.value);
    }
}

ParameterValue parameter(const Plan& plan, const State& state, const Assignment& a) {
    const int i = number_of(plan.layout, a);
    if (!a.parameter) return i >= 0;  // whether a module is enabled
    if (i < 0) throw RunError(fmt::format("'{}': the module is disabled", a.text));
    switch (a.owner) {
        case Assignment::Owner::group:
            return a.parameter->get(state.groups[i].neuron->parameters());
        case Assignment::Owner::connection:
            return a.parameter->get(state.connections[i].synapse->parameters());
        case Assignment::Owner::process:
        case Assignment::Owner::constant:
            break;
    }
    return a.parameter->get(state.modules[i].module->parameters());
}

}  // namespace forage::engine
