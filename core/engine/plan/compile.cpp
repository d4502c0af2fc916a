#include <algorithm>
#include <new>

#include <fmt/format.h>

#include "core/base/exception_message.h"
#include "core/engine/plan/plan.h"
#include "core/model/validate.h"

namespace forage::engine {
namespace {

/// Adds up what the arena will hold and remembers the largest part. In double: a file may ask for any amount.
class Budget {
  public:
    /// `rows` rows of `cells` numbers each.
    void add(double rows, Index cells, const Location& at, std::string what) {
        const double bytes = rows * static_cast<double>(Arena::stride(cells)) * sizeof(double);
        total_ += bytes;
        if (bytes > largest_) largest_ = bytes, at_ = at, what_ = std::move(what);
    }
    bool exceeded() const { return total_ > most_bytes; }
    void report(Diagnostics& diagnostics) const {
        diagnostics.error(at_,
                          fmt::format("the system needs {:.4g} GB of memory, the most is {:.4g} GB",
                                      total_ / 1e9, most_bytes / 1e9),
                          largest());
    }
    void report_exhausted(Diagnostics& diagnostics) const {
        diagnostics.error(at_, "there is not enough memory for the system", largest());
    }

  private:
    std::string largest() const {
        return what_.empty() ? "" : fmt::format("the largest part is {} = {:.4g} GB", what_, largest_ / 1e9);
    }
    double total_ = 0, largest_ = 0;
    Location at_;
    std::string what_;
};

class Compiler {
  public:
    Compiler(const model::System& system, Layout layout, const Demand& demand, std::uint64_t seed,
             Forms forms, Diagnostics& diagnostics)
        : order_(system),
          demand_(demand),
          seed_(seed),
          forms_(forms),
          diagnostics_(diagnostics),
          plan_(std::make_unique<Plan>()),
          layout_(plan_->layout) {
        plan_->layout = std::move(layout);
        plan_->overwritten = demand.overwrites_anything();
    }

    std::unique_ptr<Plan> run() {
        const int errors_before = diagnostics_.errors();
        try {
            add_groups();
            add_modules();
            add_connections();
            if (budget_.exceeded()) budget_.report(diagnostics_);
            if (diagnostics_.errors() > errors_before) return nullptr;
            prune();
            lay_out();
        } catch (const std::bad_alloc&) {
            budget_.report_exhausted(diagnostics_);
            return nullptr;
        } catch (const NotMade&) {
            return nullptr;
        }
        return std::move(plan_);
    }

  private:
    struct NotMade {};  ///< reported

    /// An object of a type with the parameters that the file sets.
    template <class Type>
    auto make(const Type& type, const model::TypeUse& use) {
        try {
            auto out = type.make();
            model::apply(use.settings, type.parameters, out->parameters());
            return out;
        } catch (const std::bad_alloc&) {
            throw;
        } catch (...) {
            diagnostics_.error(
                use.at, fmt::format("{} could not be made: {}", type.name, current_exception_message()));
            throw NotMade{};
        }
    }

    void add_groups() {
        for (std::size_t i = 0; i < layout_.groups.size(); ++i) {
            const auto& described = layout_.groups[i];
            const auto* g = order_.groups[i];
            GroupPlan plan;
            plan.path = described.path, plan.id = described.id;
            plan.shape = described.shape;
            plan.cells = plan.shape.cells;
            plan.stride = Arena::stride(plan.cells);
            plan.type = described.type;
            plan.neuron = make(plan.type, g->neuron);
            plan.random = RandomStream(seed_, g->id);
            plan.output = plan.type.output();
            plan.keeps_input = demand_.reads_input(static_cast<int>(i));
            plan.overwritten = demand_.overwrites(static_cast<int>(i));
            for (const auto& s : plan.type.states) plan.states.push_back({nullptr, s.history});
            double rows = 2 * input_kinds;
            for (const auto& s : plan.states) rows += static_cast<double>(s.depth);
            budget_.add(rows, plan.cells, g->at,
                        fmt::format("group '{}': {} numbers x {} cells", plan.path, rows, plan.cells));
            topologies_.push_back(&g->topology);
            plan_->groups.push_back(std::move(plan));
        }
    }

    void add_modules() {
        for (std::size_t n = 0; n < layout_.modules.size(); ++n) {
            const auto& described = layout_.modules[n];
            const auto* p = order_.modules[n];
            ModulePlan plan;
            plan.process = described.process, plan.process_id = described.process_id;
            plan.type = described.type;
            plan.module = make(plan.type, *p->module);
            plan.ports = described.ports;
            plan.ports.random = RandomStream(seed_, p->id);
            plan.input_groups = described.input_groups, plan.output_groups = described.output_groups;
            const auto references = cross_references(*p->module, plan.type, true);
            for (std::size_t i = 0; i < plan.output_groups.size(); ++i) {
                if (plan.output_groups[i] < 0) continue;
                auto& group = plan_->groups[plan.output_groups[i]];
                budget_.add(1, group.cells, references[i].at,
                            fmt::format("output '{}' of process '{}'", references[i].name, p->name));
                constexpr auto excitatory = static_cast<std::size_t>(InputKind::excitatory);
                if (!group.type.reads[excitatory]) continue;
                group.module_inputs.emplace_back(static_cast<int>(n), static_cast<int>(i));
                group.fed[excitatory] = true;
            }
            plan_->modules.push_back(std::move(plan));
        }
    }

    void add_connections() {
        for (std::size_t n = 0; n < layout_.connections.size(); ++n) {
            const auto& described = layout_.connections[n];
            const auto* c = order_.connections[n];
            ConnectionPlan plan;
            plan.id = described.id, plan.name = described.name, plan.kind = described.kind;
            plan.source = described.source, plan.target = described.target;
            auto& target = plan_->groups[plan.target];
            plan.type = described.type;
            plan.synapse = make(plan.type, *c->synapse);
            plan.effective = described.effective;
            if (!(forms_ == Forms::fastest && plan.type.has_gain && make_regular(*c, plan)) &&
                !make_list(*c, plan))
                continue;  // reported
            target.incoming.push_back(static_cast<int>(plan_->connections.size()));
            bool& fed = target.fed[static_cast<std::size_t>(c->kind)];  // by a module, too
            plan.first = plan.effective && !fed;
            fed |= plan.effective;
            plan_->connections.push_back(std::move(plan));
        }
    }

    /// Marks what is not computed. What is computed is numbered in `updated`.
    void prune() {
        const Pruned pruned = engine::prune(layout_, demand_);
        auto& groups = plan_->groups;
        for (std::size_t i = 0; i < groups.size(); ++i) {
            groups[i].pruned = pruned.groups[i];
            groups[i].history = 0;
            std::erase_if(groups[i].incoming, [&](int c) { return pruned.connections[c]; });
            if (!groups[i].pruned) plan_->updated.push_back(static_cast<int>(i));
        }
        for (std::size_t i = 0; i < plan_->connections.size(); ++i) {
            auto& c = plan_->connections[i];
            c.pruned = pruned.connections[i];
            int& history = groups[c.source].history;
            if (!c.pruned && !c.plastic) history = std::max(history, c.longest_delay);
        }
        for (std::size_t m = 0; m < plan_->modules.size(); ++m)
            for (const bool left_out : pruned.outputs[m]) plan_->modules[m].read.push_back(!left_out);
    }

    const model::Topology& topology_of(int group) const {
        return *topologies_[static_cast<std::size_t>(group)];
    }

    /// For a connection that needs no list of synapses; false for others. Without a kernel when memory does
    /// not suffice, which run() reports.
    bool make_regular(const model::Connection& c, ConnectionPlan& plan) {
        const auto regular = connectivity::regular(c, topology_of(plan.source), topology_of(plan.target));
        if (!regular) return false;
        auto& source = plan_->groups[static_cast<std::size_t>(plan.source)];
        plan.synapses = regular->synapses;
        for (const auto& tap : regular->taps) plan.longest_delay = std::max(plan.longest_delay, tap.delay);
        lengthen(source, c, plan.longest_delay);
        if (!budget_.exceeded())
            plan.kernel =
                make_kernel(*regular, source.shape.cells,
                            plan_->groups[static_cast<std::size_t>(plan.target)].shape.cells, *plan.synapse);
        return true;
    }

    /// False when it cannot be made: reported.
    bool make_list(const model::Connection& c, ConnectionPlan& plan) {
        auto& source = plan_->groups[static_cast<std::size_t>(plan.source)];
        auto& target = plan_->groups[static_cast<std::size_t>(plan.target)];
        auto synapses =
            connectivity::connect(c, topology_of(plan.source), topology_of(plan.target), seed_, diagnostics_);
        if (synapses.size() == 0) return false;
        synapses.distance = std::vector<double>();  // attenuation and delay say it all
        plan.synapses = synapses.size();
        plan.longest_delay = *std::max_element(synapses.delay.begin(), synapses.delay.end());
        if (plan.type.has_gain) {
            lengthen(source, c, plan.longest_delay);
            if (budget_.exceeded()) return false;
            plan.kernel = make_kernel(std::move(synapses), source.shape.cells, target.shape.cells,
                                      *plan.synapse, forms_);
            return true;
        }
        plan.feedback = feedback_states(c, plan.type, target, plan.longest_delay);
        add_synapse_states(c, plan, plan.longest_delay);
        if (budget_.exceeded()) return false;
        auto kernel = make_plastic(std::move(synapses), source.shape.cells, target.shape.cells, plan.type,
                                   *plan.synapse, plan_->arena, forms_);
        plan.plastic = kernel.get();
        plan.kernel = std::move(kernel);
        return true;
    }

    /// Makes the source keep its activity for a delay.
    void lengthen(GroupPlan& source, const model::Connection& c, int delay) {
        if (delay <= source.history) return;
        budget_.add(delay - source.history, source.cells, c.at,
                    fmt::format("connection '{}': delay {} x {} cells", c.name, delay, source.cells));
        source.history = delay;
    }

    void add_synapse_states(const model::Connection& c, const ConnectionPlan& plan, int longest) {
        const auto numbers = plan.type.states.size() + plan.type.feedback.size() + 1;
        const double past = longest > 0 ? longest + 1.0 : 0;
        budget_.add(static_cast<double>(numbers) + past, static_cast<Index>(plan.synapses), c.at,
                    fmt::format("connection '{}': ({} numbers + delay {}) x {} synapses", c.name, numbers,
                                longest, plan.synapses));
    }

    /// The states of the target that feed back, -1 for an unset one. Their history grows to the longest delay
    /// + 1, as in the original; so an update that reads the state's last value reads one of so many cycles
    /// ago.
    std::vector<int> feedback_states(const model::Connection& c, const SynapseType& type, GroupPlan& target,
                                     int longest) {
        std::vector<int> out;
        for (const auto& f : type.feedback) {
            int state = -1;
            for (const auto& r : c.synapse->feedback)
                for (std::size_t s = 0; s < target.type.states.size(); ++s)
                    if (r.name == f.name && r.target == target.type.states[s].name)
                        state = static_cast<int>(s);
            if (state >= 0) {
                auto& depth = target.states[static_cast<std::size_t>(state)].depth;
                if (depth <= longest) {
                    budget_.add(
                        static_cast<double>(longest + 1 - depth), target.cells, c.at,
                        fmt::format("connection '{}': delay {} x {} cells", c.name, longest, target.cells));
                    depth = longest + 1;
                }
            }
            out.push_back(state);
        }
        return out;
    }

    void lay_out() {
        Arena& arena = plan_->arena;
        // What every cycle touches lies together: states and one row of each input that is delivered.
        for (auto& g : plan_->groups) {
            for (auto& s : g.states) g.state_offsets.push_back(arena.reserve(g.cells, s.depth));
            for (std::size_t k = 0; k < input_kinds; ++k)
                if (g.fed[k]) g.input_offsets[k][0] = arena.reserve(g.cells);
        }
        for (auto& g : plan_->groups) {
            for (std::size_t k = 0; k < input_kinds; ++k) {
                if (!g.fed[k]) g.input_offsets[k][0] = arena.reserve(g.cells);
                g.input_offsets[k][1] = arena.reserve(g.cells);
            }
            if (g.history > 0) g.history_offset = arena.reserve(g.cells, g.history + 1);
        }
        for (auto& m : plan_->modules)
            for (const int g : m.output_groups)
                m.output_offsets.push_back(
                    arena.reserve(g < 0 ? 0 : plan_->groups[static_cast<std::size_t>(g)].cells));
        arena.allocate();

        for (auto& g : plan_->groups) {
            for (std::size_t s = 0; s < g.states.size(); ++s) {
                g.states[s].ring = arena.at(g.state_offsets[s]);
                if (const double initial = g.type.states[s].initial; initial != 0)
                    for (std::int64_t row = 0; row < g.states[s].depth; ++row)
                        std::fill_n(g.states[s].ring + row * g.stride, g.cells, initial);
            }
            for (std::size_t k = 0; k < g.inputs.size(); ++k)
                for (std::size_t i = 0; i < 2; ++i)
                    g.inputs[k][i] = arena.at(g.input_offsets[k][g.keeps_input ? i : 0]);
            if (g.history > 0) g.history_ring = arena.at(g.history_offset);
        }
        for (auto& m : plan_->modules) {
            for (const int g : m.input_groups)
                m.in.emplace_back(nullptr, g < 0 ? 0 : plan_->groups[static_cast<std::size_t>(g)].cells);
            m.written.resize(m.output_groups.size());
            m.changed.resize(m.output_groups.size());
            m.ever_written.resize(m.output_groups.size());
            for (std::size_t i = 0; i < m.output_groups.size(); ++i) {
                const int g = m.output_groups[i];
                const Index cells = g < 0 ? 0 : plan_->groups[static_cast<std::size_t>(g)].cells;
                m.out.emplace_back(arena.at(m.output_offsets[i]), cells);
                m.last.emplace_back(Eigen::ArrayXd::Zero(cells <= ModulePlan::compared_output ? cells : 0));
            }
        }
        for (auto& c : plan_->connections) {
            if (!c.plastic) continue;
            const auto& target = plan_->groups[static_cast<std::size_t>(c.target)];
            std::vector<Ring> feedback;
            for (const int s : c.feedback) {
                if (s < 0)
                    feedback.push_back({nullptr, 1, 0});
                else
                    feedback.push_back({target.states[static_cast<std::size_t>(s)].ring,
                                        target.states[static_cast<std::size_t>(s)].depth, target.stride});
            }
            c.plastic->place(arena, std::move(feedback));
        }
    }

    UpdateOrder order_;
    const Demand& demand_;
    std::uint64_t seed_;
    Forms forms_;
    Diagnostics& diagnostics_;
    std::unique_ptr<Plan> plan_;
    const Layout& layout_;
    std::vector<const model::Topology*> topologies_;
    Budget budget_;
};

}  // namespace

std::unique_ptr<Plan> compile(const model::System& system, Layout layout, const Demand& demand,
                              std::uint64_t seed, Forms forms, Diagnostics& diagnostics) {
    return Compiler(system, std::move(layout), demand, seed, forms, diagnostics).run();
}

}  // namespace forage::engine
