// Parameters that change while the system runs.
#include <algorithm>
#include <map>
#include <memory>

#include <fmt/format.h>

#include "core/base/named_file.h"
#include "core/engine/group_cycle.h"
#include "core/engine/plan/plan.h"
#include "core/engine/simulation.h"

namespace forage::engine {
namespace {

using model::Assignment;

template <class Items, class Id>
auto* find(Items& items, Id id, const std::string& wanted) {
    const auto it = std::find_if(items.begin(), items.end(), [&](const auto& i) { return i.*id == wanted; });
    return it == items.end() ? nullptr : &*it;
}

/// The object that holds the parameter; null when its module is disabled.
void* holder(Plan& plan, const Assignment& a) {
    switch (a.owner) {
        case Assignment::Owner::group:
            return find(plan.groups, &GroupPlan::id, a.id)->neuron->parameters();
        case Assignment::Owner::connection:
            return find(plan.connections, &ConnectionPlan::id, a.id)->synapse->parameters();
        case Assignment::Owner::process:
            break;
    }
    ModulePlan* module = find(plan.modules, &ModulePlan::process_id, a.id);
    return module ? module->module->parameters() : nullptr;
}

struct Refusal {
    std::string why, hint;
};

/// Why a parameter cannot change while the system runs; empty when it can.
std::optional<Refusal> refusal(const Assignment& a, const void* holder) {
    const std::string before = "set it before the run";
    if (!a.parameter) return Refusal{"a module cannot be switched on or off while the system runs", before};
    if (!holder) return Refusal{"the module is disabled", "enable it: enableModule=true"};
    if (a.parameter->at_start)
        return Refusal{fmt::format("'{}' is read at start only", a.parameter->name), before};
    return std::nullopt;
}

/// Copies of what holds parameters, in which changes are tried.
class Rehearsal {
  public:
    Rehearsal(Plan& plan, Diagnostics& diagnostics) : plan_(plan), diagnostics_(diagnostics) {}

    void make(const Assignment& a) {
        switch (a.owner) {
            case Assignment::Owner::group:
                return with_type(neurons_, *find(plan_.groups, &GroupPlan::id, a.id), &GroupPlan::neuron, a);
            case Assignment::Owner::connection:
                return with_type(synapses_, *find(plan_.connections, &ConnectionPlan::id, a.id),
                                 &ConnectionPlan::synapse, a);
            case Assignment::Owner::process:
                break;
        }
        const ModulePlan& m = *find(plan_.modules, &ModulePlan::process_id, a.id);
        ModuleInstance& copy = copied(modules_, m, &ModulePlan::module);
        a.parameter->set(copy.parameters(), a.value);
        Diagnostics found;
        try {
            copy.check(m.ports, found);
        } catch (const FileError& e) {
            return report(e, diagnostics_);
        }
        pass_on(a, found);
    }

  private:
    template <class T>
    using Copies = std::map<std::string, std::unique_ptr<T>>;

    template <class T, class Item>
    static T& copied(Copies<T>& copies, const Item& item, std::unique_ptr<T> Item::*instance) {
        auto& copy = copies[key(item)];
        if (!copy) {
            copy = item.type.make();
            for (const auto& p : item.type.parameters)
                p.set(copy->parameters(), p.get((item.*instance)->parameters()));
        }
        return *copy;
    }
    static const std::string& key(const GroupPlan& g) { return g.id; }
    static const std::string& key(const ModulePlan& m) { return m.process_id; }
    static const std::string& key(const ConnectionPlan& c) { return c.id; }

    template <class T, class Item>
    void with_type(Copies<T>& copies, const Item& item, std::unique_ptr<T> Item::*instance,
                   const Assignment& a) {
        T& copy = copied(copies, item, instance);
        a.parameter->set(copy.parameters(), a.value);
        if (!item.type.check) return;
        Diagnostics found;
        item.type.check(copy.parameters(), found);
        pass_on(a, found);
    }
    void pass_on(const Assignment& a, const Diagnostics& found) {
        for (Diagnostic d : found.all()) {
            d.where = a.at;
            d.message = fmt::format("'{}': {}", a.text, d.message);
            diagnostics_.add(std::move(d));
        }
    }

    Plan& plan_;
    Diagnostics& diagnostics_;
    Copies<NeuronInstance> neurons_;
    Copies<SynapseInstance> synapses_;
    Copies<ModuleInstance> modules_;
};

}  // namespace

void Simulation::check(std::span<const Assignment> changes, Diagnostics& diagnostics) const {
    Rehearsal rehearsal(*plan_, diagnostics);
    for (const auto& a : changes) {
        if (const auto refused = refusal(a, holder(*plan_, a)))
            diagnostics.error(a.at, fmt::format("'{}': {}", a.text, refused->why), refused->hint);
        else
            rehearsal.make(a);
    }
}

void Simulation::set(const Assignment& a) {
    if (delivers_early_)
        throw std::logic_error(
            "parameters change between cycles, not between update_groups() and "
            "update_connections()");
    void* object = holder(*plan_, a);
    if (const auto refused = refusal(a, object))
        throw RunError(fmt::format("'{}': {}", a.text, refused->why));
    a.parameter->set(object, a.value);
    if (a.owner == Assignment::Owner::group) touch(*find(plan_->groups, &GroupPlan::id, a.id), cycle_);
    if (a.owner == Assignment::Owner::connection)
        find(plan_->connections, &ConnectionPlan::id, a.id)->changed = true;
}

}  // namespace forage::engine
