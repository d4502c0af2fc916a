#include <algorithm>
#include <map>

#include "core/engine/plan.h"
#include "core/model/lookup.h"
#include "core/model/validate.h"

namespace forage::engine {
namespace {

template <class T>
std::vector<const T*> by_id(const std::vector<T>& items) {
    std::vector<const T*> out;
    for (const auto& item : items) out.push_back(&item);
    std::sort(out.begin(), out.end(), [](const T* a, const T* b) { return a->id < b->id; });
    return out;
}

class Compiler {
  public:
    Compiler(const model::System& system, const Registry& registry, std::uint64_t seed, Forms forms, Diagnostics& diagnostics)
        : system_(system), registry_(registry), seed_(seed), forms_(forms), diagnostics_(diagnostics),
          plan_(std::make_unique<Plan>()) {}

    std::unique_ptr<Plan> run() {
        const int errors_before = diagnostics_.errors();
        add_groups();
        add_modules();
        add_connections();
        if (diagnostics_.errors() > errors_before) return nullptr;
        lay_out();
        return std::move(plan_);
    }

  private:
    void add_groups() {
        const auto paths = model::group_paths(system_);
        std::map<const model::Group*, std::string> path_of;
        std::vector<const model::Group*> groups;
        for (const auto& p : system_.processes)
            for (const auto& g : p.groups) {
                path_of[&g] = paths[groups.size()];
                groups.push_back(&g);
            }
        std::sort(groups.begin(), groups.end(), [](const auto* a, const auto* b) { return a->id < b->id; });
        for (const auto* g : groups) {
            GroupPlan plan;
            plan.path = path_of[g], plan.id = g->id;
            plan.shape = model::shape(g->topology);
            plan.cells = plan.shape.cells;
            plan.stride = Arena::stride(plan.cells);
            plan.type = *registry_.neuron(g->neuron.type);
            plan.neuron = plan.type.make();
            model::apply(g->neuron.settings, plan.type.parameters, plan.neuron->parameters());
            plan.random = RandomStream(seed_, g->id);
            for (const auto& s : plan.type.states) plan.states.push_back({nullptr, s.history});
            group_at_[g->id] = static_cast<int>(plan_->groups.size());
            topology_of_.push_back(&g->topology);
            plan_->groups.push_back(std::move(plan));
        }
    }

    int group_of(const std::string& id) const {
        const auto it = group_at_.find(id);
        return it == group_at_.end() ? -1 : it->second;
    }

    void add_modules() {
        for (const auto* p : by_id(system_.processes)) {
            if (!p->module || !p->module_enabled) continue;
            ModulePlan plan;
            plan.process = std::string(model::trim(p->name)), plan.process_id = p->id, plan.type_name = p->module->type;
            plan.type = *registry_.module(p->module->type);
            plan.module = plan.type.make();
            model::apply(p->module->settings, plan.type.parameters, plan.module->parameters());
            plan.ports.process = plan.process;
            plan.ports.random = RandomStream(seed_, p->id);
            for (const bool outputs : {false, true}) {
                auto& groups = outputs ? plan.output_groups : plan.input_groups;
                auto& ports = outputs ? plan.ports.outputs : plan.ports.inputs;
                for (const auto& r : references(*p->module, plan.type, outputs)) {
                    const int group = group_of(r.target);
                    groups.push_back(group);
                    ports.push_back({r.name, {}, {}});
                    if (group >= 0) {
                        ports.back().path = plan_->groups[static_cast<std::size_t>(group)].path;
                        ports.back().shape = plan_->groups[static_cast<std::size_t>(group)].shape;
                    }
                }
            }
            plan_->modules.push_back(std::move(plan));
        }
    }

    /// What the file sets, in the type's order of declaration, or in file order for a type that takes any.
    static std::vector<model::CrossReference> references(const model::ModuleUse& use, const ModuleType& type, bool outputs) {
        const auto& given = outputs ? use.outputs : use.inputs;
        if (type.any_ports) return given;
        std::vector<model::CrossReference> out;
        for (const auto& port : type.ports) {
            if (port.is_output != outputs) continue;
            const auto it = std::find_if(given.begin(), given.end(), [&](const auto& r) { return r.name == port.name; });
            out.push_back(it != given.end() ? *it : model::CrossReference{port.name, {}, {}});
        }
        return out;
    }

    void add_connections() {
        for (const auto* c : by_id(system_.connections)) {
            ConnectionPlan plan;
            plan.id = c->id, plan.name = c->name, plan.kind = c->kind;
            plan.source = group_of(c->source), plan.target = group_of(c->target);
            auto& source = plan_->groups[static_cast<std::size_t>(plan.source)];
            auto& target = plan_->groups[static_cast<std::size_t>(plan.target)];
            auto synapses = connectivity::connect(*c, *topology_of_[static_cast<std::size_t>(plan.source)],
                                                  *topology_of_[static_cast<std::size_t>(plan.target)], seed_, diagnostics_);
            if (synapses.size() == 0) continue;  // reported
            plan.synapses = synapses.size();
            plan.type = *registry_.synapse(c->synapse->type);
            plan.synapse = plan.type.make();
            model::apply(c->synapse->settings, plan.type.parameters, plan.synapse->parameters());
            plan.effective = target.type.reads[static_cast<std::size_t>(c->kind)];
            const int longest = *std::max_element(synapses.delay.begin(), synapses.delay.end());
            if (plan.type.has_gain) {
                source.history = std::max(source.history, longest);
                plan.kernel = make_kernel(synapses, source.shape.cells, target.shape.cells, *plan.synapse, forms_);
            } else {
                feedback_.emplace_back(plan_->connections.size(), feedback_states(*c->synapse, plan.type, target, longest));
                plastic_synapses_.push_back(std::move(synapses));
            }
            target.incoming.push_back(static_cast<int>(plan_->connections.size()));
            plan_->connections.push_back(std::move(plan));
        }
        // The kernels refer to the types of their plans, which have their final place only now.
        for (std::size_t i = 0; i < feedback_.size(); ++i) {
            auto& c = plan_->connections[feedback_[i].first];
            auto kernel = std::make_unique<PlasticKernel>(std::move(plastic_synapses_[i]),
                                                          plan_->groups[static_cast<std::size_t>(c.target)].shape.cells, c.type,
                                                          *c.synapse, plan_->arena);
            c.plastic = kernel.get();
            c.kernel = std::move(kernel);
        }
    }

    /// The states of the target that feed back, -1 for an unset one. Their history grows to the longest delay + 1, as
    /// in the original; so an update that reads the state's last value reads one of so many cycles ago.
    static std::vector<int> feedback_states(const model::SynapseUse& use, const SynapseType& type, GroupPlan& target, int longest) {
        std::vector<int> out;
        for (const auto& f : type.feedback) {
            int state = -1;
            for (const auto& r : use.feedback)
                for (std::size_t s = 0; s < target.type.states.size(); ++s)
                    if (r.name == f.name && r.target == target.type.states[s].name) state = static_cast<int>(s);
            if (state >= 0) {
                auto& depth = target.states[static_cast<std::size_t>(state)].depth;
                depth = std::max<std::int64_t>(depth, longest + 1);
            }
            out.push_back(state);
        }
        return out;
    }

    void lay_out() {
        Arena& arena = plan_->arena;
        for (auto& g : plan_->groups) {
            for (auto& s : g.states) g.state_offsets.push_back(arena.reserve(g.cells, s.depth));
            for (auto& kind : g.input_offsets)
                for (auto& offset : kind) offset = arena.reserve(g.cells);
            if (g.history > 0) g.history_offset = arena.reserve(g.cells, g.history + 1);
        }
        for (auto& m : plan_->modules)
            for (const int g : m.output_groups)
                m.output_offsets.push_back(arena.reserve(g < 0 ? 0 : plan_->groups[static_cast<std::size_t>(g)].cells));
        arena.allocate();

        for (auto& g : plan_->groups) {
            for (std::size_t s = 0; s < g.states.size(); ++s) g.states[s].ring = arena.at(g.state_offsets[s]);
            for (std::size_t k = 0; k < g.inputs.size(); ++k)
                for (std::size_t i = 0; i < 2; ++i) g.inputs[k][i] = arena.at(g.input_offsets[k][i]);
            if (g.history > 0) g.history_ring = arena.at(g.history_offset);
        }
        for (auto& m : plan_->modules) {
            for (const int g : m.input_groups) m.in.emplace_back(nullptr, g < 0 ? 0 : plan_->groups[static_cast<std::size_t>(g)].cells);
            for (std::size_t i = 0; i < m.output_groups.size(); ++i) {
                const int g = m.output_groups[i];
                m.out.emplace_back(arena.at(m.output_offsets[i]), g < 0 ? 0 : plan_->groups[static_cast<std::size_t>(g)].cells);
            }
        }
        for (const auto& [index, states] : feedback_) {
            auto& c = plan_->connections[index];
            const auto& target = plan_->groups[static_cast<std::size_t>(c.target)];
            std::vector<Feedback> feedback;
            for (const int s : states) {
                if (s < 0) feedback.push_back({nullptr, 1, 0});
                else feedback.push_back({target.states[static_cast<std::size_t>(s)].ring, target.states[static_cast<std::size_t>(s)].depth, target.stride});
            }
            c.plastic->place(arena, std::move(feedback));
        }
    }

    const model::System& system_;
    const Registry& registry_;
    std::uint64_t seed_;
    Forms forms_;
    Diagnostics& diagnostics_;
    std::unique_ptr<Plan> plan_;
    std::map<std::string, int> group_at_;
    std::vector<const model::Topology*> topology_of_;
    std::vector<std::pair<std::size_t, std::vector<int>>> feedback_;  ///< by connection
    std::vector<connectivity::Synapses> plastic_synapses_;
};

}  // namespace

std::unique_ptr<Plan> compile(const model::System& system, const Registry& registry, std::uint64_t seed, Forms forms,
                              Diagnostics& diagnostics) {
    return Compiler(system, registry, seed, forms, diagnostics).run();
}

}  // namespace forage::engine
