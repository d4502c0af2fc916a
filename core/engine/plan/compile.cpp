#include "core/engine/plan/compile.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <new>

#include <fmt/format.h>

#include "core/base/exception_message.h"
#include "core/connectivity/warn.h"
#include "core/model/arrays.h"
#include "core/model/validate.h"

namespace forage::engine {
namespace {

/// Adds up what the arena will hold and remembers the largest part. In double: a file may ask for any amount.
class Budget {
  public:
    /// `rows` rows of `cells` numbers each.
    void add(double rows, Index cells, const Location& at, std::string what) {
        const double bytes = rows * static_cast<double>(Rows::stride(cells)) * sizeof(double);
        total_ += bytes;
        if (bytes > largest_) largest_ = bytes, at_ = at, what_ = std::move(what);
    }
    bool exceeded() const { return total_ > max_bytes; }
    void report(Diagnostics& diagnostics) const {
        diagnostics.error(at_,
                          fmt::format("the system needs {:.4g} GB of memory, the most is {:.4g} GB",
                                      total_ / 1e9, max_bytes / 1e9),
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
    Compiler(const model::System& system, std::shared_ptr<const Layout> layout, const Demand& demand,
             const Options& options, Diagnostics& diagnostics)
        : constants_(system),
          groups_of_(system),
          order_(system),
          demand_(demand),
          options_(options),
          forms_(options.general_forms ? Forms::general : Forms::fastest),
          diagnostics_(diagnostics),
          plan_(std::make_shared<Plan>(std::move(layout), demand)),
          layout_(plan_->layout) {
        plan_->overwritten = demand.overwrites_anything();
        pruned_ = prune(layout_, demand);
    }

    Compiled run() {
        const int errors_before = diagnostics_.errors();
        std::unique_ptr<State> state;
        try {
            add_groups();
            add_modules();
            add_connections();
            if (budget_.exceeded()) budget_.report(diagnostics_);
            if (diagnostics_.errors() > errors_before) return {};
            lay_out();
            order_steps(*plan_);
            for (const auto& add : initial_) add();
            state = std::make_unique<State>(*plan_, options_);
            if (plan_->seed) plan_->first_numbers = {};  // no other state begins with them
        } catch (const std::bad_alloc&) {
            budget_.report_exhausted(diagnostics_);
            return {};
        } catch (const NotMade&) {
            return {};
        }
        return {std::move(plan_), std::move(state)};
    }

  private:
    struct NotMade {};  ///< reported

    /// The parameters of an object of a type: those that the file sets, and the defaults of the others.
    template <class Type>
    std::vector<ParameterValue> parameters(const Type& type, const model::TypeUse& use) {
        try {
            const auto made = type.make();
            model::apply(use, type.parameters, made->parameters());
            std::vector<ParameterValue> out;
            for (const auto& p : type.parameters) out.push_back(p.get(made->parameters()));
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
        for (int i = 0; i < std::ssize(layout_.groups); ++i) {
            const auto& about = layout_.groups[i];
            const auto* g = order_.groups[i];
            auto& plan = plan_->groups.emplace_back();
            plan.cells = about.shape.cells;
            plan.stride = Rows::stride(plan.cells);
            plan.output = about.type.output();
            plan.pruned = pruned_.groups[i];
            plan.keeps_input = demand_.reads_input(i);
            plan.overwritten = demand_.overwrites(i);
            double rows = 2 * static_cast<double>(about.type.input_count());
            for (const auto& s : about.type.states) {
                plan.states.push_back({0, s.history});
                rows += static_cast<double>(s.history);
            }
            plan.parameters = parameters(about.type, g->neuron);
            if (plan.pruned) continue;
            add_initial(*g, about, i);
            budget_.add(rows, plan.cells, g->at,
                        fmt::format("group '{}': {} numbers x {} cells", about.path, rows, plan.cells));
        }
    }

    void add_modules() {
        for (int i = 0; i < std::ssize(layout_.modules); ++i) {
            const auto& about = layout_.modules[i];
            const auto& use = *order_.modules[i]->module;
            auto& plan = plan_->modules.emplace_back();
            plan.parameters = parameters(about.type, use);
            const auto references = cross_references(use, about.type, true);
            for (int port = 0; port < std::ssize(references); ++port) {
                plan.read.push_back(!pruned_.outputs[i][port]);
                const int group = about.output_groups[port];
                if (group < 0) continue;
                auto& target = plan_->groups[group];
                budget_.add(1, target.cells, references[port].at,
                            fmt::format("output '{}' of process '{}'", references[port].name, about.process));
                constexpr auto kind = static_cast<std::size_t>(InputKind::excitatory);
                if (!layout_.groups[group].type.reads[kind]) continue;
                target.module_inputs.emplace_back(i, port);
                target.fed[kind] = true;
            }
        }
    }

    void add_connections() {
        for (int i = 0; i < std::ssize(layout_.connections); ++i) {
            const auto& about = layout_.connections[i];
            const auto* c = order_.connections[i];
            auto& plan = plan_->connections.emplace_back();
            plan.source = about.source, plan.target = about.target, plan.kind = about.kind;
            plan.state = about.state;
            auto& source = plan_->groups[plan.source];
            source.shows_states |= plan.state != source.output;
            plan.effective = about.effective;
            plan.pruned = pruned_.connections[i];
            plan.reads_states = demand_.reads_synapses(i);
            plan.parameters = parameters(about.type, model::synapse_of(*c));
            if (connectivity::is_drawn(*c)) plan_->seed = options_.seed;
            if (!(forms_ == Forms::fastest && about.type.has_gain &&
                  (make_regular(*c, plan) || make_matrix(*c, plan))))
                make_list(*c, about, plan);
            if (!plan.kernel) continue;  // pruned, or reported
            auto& target = plan_->groups[plan.target];
            target.incoming.push_back(i);
            target.delivery_cost += plan.kernel->cost();
            bool& fed = target.fed[static_cast<std::size_t>(plan.kind)];  // by a module, too
            plan.first = plan.effective && !fed;
            fed |= plan.effective;
        }
    }

    const model::Topology& topology_of(int group) const { return order_.groups[group]->topology; }

    /// For a connection that needs no list of synapses; false for others. Without a kernel when it is pruned,
    /// or when memory does not suffice, which run() reports.
    bool make_regular(const model::Connection& c, ConnectionPlan& plan) {
        const auto regular = connectivity::regular(c, topology_of(plan.source), topology_of(plan.target));
        if (!regular) return false;
        plan.synapses = regular->synapses;
        for (const auto& tap : regular->taps) plan.longest_delay = std::max(plan.longest_delay, tap.delay);
        if (plan.pruned) return true;
        lengthen(c, plan);
        if (!budget_.exceeded())
            plan.kernel = make_kernel(*regular, static_cast<int>(plan_->groups[plan.target].cells));
        return true;
    }

    /// For a matrix of weights that nearly all cells have. Without a kernel as after make_regular().
    bool make_matrix(const model::Connection& c, ConnectionPlan& plan) {
        const auto* weights = std::get_if<model::Weights>(&c.pattern);
        const auto* delay = std::get_if<model::UniformFunction>(&c.delay.form);
        if (!weights || weights->is_list || !delay) return false;
        const auto& source = layout_.groups[plan.source].shape;
        const auto& target = layout_.groups[plan.target].shape;
        const auto& array = *weights->array.array;
        if (!fits_matrix(array, target)) return false;
        plan.synapses = array.rows() * array.columns() - array.left_out();
        plan.longest_delay = std::max(0, static_cast<int>(delay->value));
        if (plan.pruned) return true;
        lengthen(c, plan);
        budget_.add(static_cast<double>(array.columns()), target.cells, c.at,
                    fmt::format("connection '{}': {} x {} weights", c.name, array.rows(), array.columns()));
        if (!budget_.exceeded()) plan.kernel = make_kernel(array, source, target, plan.longest_delay);
        return true;
    }

    /// Without a kernel when it is pruned, or cannot be made: reported.
    void make_list(const model::Connection& c, const Layout::Connection& about, ConnectionPlan& plan) {
        auto synapses = connectivity::connect(c, topology_of(plan.source), topology_of(plan.target),
                                              options_.seed, diagnostics_);
        if (synapses.size() == 0) return;
        connectivity::warn_of_wiring(c, *order_.groups[plan.source], *order_.groups[plan.target], synapses,
                                     diagnostics_);
        if (about.type.has_gain) {
            for (std::size_t i = 0; i < synapses.weight.size(); ++i)
                synapses.attenuation[i] = -synapses.weight[i];
            if (!synapses.weight.empty()) synapses.reference = 0;
            synapses.weight = std::vector<double>();
        }
        synapses.distance = std::vector<double>();  // attenuation and delay say it all
        plan.synapses = synapses.size();
        plan.longest_delay = *std::max_element(synapses.delay.begin(), synapses.delay.end());
        const auto &source = layout_.groups[plan.source].shape, &target = layout_.groups[plan.target].shape;
        if (about.type.has_gain) {
            if (plan.pruned) return;
            lengthen(c, plan);
            if (!budget_.exceeded()) plan.kernel = make_kernel(std::move(synapses), source, target, forms_);
            return;
        }
        plan.feedback = feedback_states(c, about.type, plan);
        if (plan.pruned) return;
        add_synapse_states(c, about.type, plan);
        if (budget_.exceeded()) return;
        add_initial(c, about, plan, synapses);
        const int number = static_cast<int>(plan_->connections.size()) - 1;
        if (!synapses.weight.empty())
            plan_->first_numbers.push_back({.connection = number,
                                            .state = state_named(about.type, "weight"),
                                            .values = std::move(synapses.weight)});
        if (plan.reads_states) plan.pre = synapses.pre, plan.post = synapses.post;
        plan.first_number = plan_->rows.size();
        auto kernel = make_plastic(std::move(synapses), source, target, about.type, plan.reads_states,
                                   plan_->rows, forms_);
        plan.numbers = plan_->rows.size() - plan.first_number;
        plan.plastic = kernel.get();
        plan.kernel = std::move(kernel);
    }

    /// Makes the source keep what a connection transmits for the connection's delay.
    void lengthen(const model::Connection& c, const ConnectionPlan& plan) {
        auto& source = plan_->groups[plan.source];
        if (plan.state == source.output)
            return lengthen(source.history, plan.longest_delay, source.cells, c, plan);
        lengthen(source.states[plan.state].depth, plan.longest_delay + 1, source.cells, c, plan);
    }
    template <class Depth>
    void lengthen(Depth& depth, int needed, Index cells, const model::Connection& c,
                  const ConnectionPlan& plan) {
        if (needed <= depth) return;
        budget_.add(static_cast<double>(needed - depth), cells, c.at,
                    fmt::format("connection '{}': delay {} x {} cells", c.name, plan.longest_delay, cells));
        depth = needed;
    }

    void add_synapse_states(const model::Connection& c, const SynapseType& type, const ConnectionPlan& plan) {
        const auto numbers = type.states.size() + type.feedback.size() + 1;
        const double past = plan.longest_delay > 0 ? plan.longest_delay + 1.0 : 0;
        budget_.add(static_cast<double>(numbers) + past, static_cast<Index>(plan.synapses), c.at,
                    fmt::format("connection '{}': ({} numbers + delay {}) x {} synapses", c.name, numbers,
                                plan.longest_delay, plan.synapses));
    }

    /// The states of the target that feed back, -1 for an unset one. Their history grows to the longest delay
    /// + 1, as in the original: an update that reads the state's last value reads one of so many cycles ago.
    std::vector<int> feedback_states(const model::Connection& c, const SynapseType& type,
                                     const ConnectionPlan& plan) {
        const int longest = plan.longest_delay;
        const auto& states = layout_.groups[plan.target].type.states;
        auto& target = plan_->groups[plan.target];
        std::vector<int> out;
        for (const auto& f : type.feedback) {
            int state = -1;
            const int needed = longest + f.ago + 1;
            for (int s = 0; s < std::ssize(states); ++s)
                if (f.own && (f.state.empty() ? states[s].output : f.state == states[s].name)) state = s;
            for (const auto& r : c.synapse->feedback)
                for (int s = 0; s < std::ssize(states); ++s)
                    if (!f.own && r.name == f.name && r.target == states[s].name) state = s;
            if (state >= 0) lengthen(target.states[state].depth, needed, target.cells, c, plan);
            out.push_back(state);
        }
        return out;
    }

    static int state_named(const auto& type, std::string_view name) {
        const auto it = std::ranges::find(type.states, name, [](const auto& s) { return s.name; });
        return static_cast<int>(it - type.states.begin());
    }
    /// What random initial values are drawn from: none of the streams in which types and connections draw.
    RandomStream initial_stream(const std::string& id, int state) const {
        return {options_.seed, id, 0x1000u + static_cast<std::uint32_t>(state)};
    }

    /// The values with which a state begins.
    std::vector<double> numbers(const model::Initial& i, const model::Process* scope,
                                const RandomStream& stream, std::size_t count,
                                std::span<const std::size_t> index = {}) {
        if (model::is_drawn(i, constants_, scope)) plan_->seed = options_.seed;
        return model::initial_values(i, constants_, scope, stream, count, index);
    }

    void add_initial(const model::Group& g, const Layout::Group& about, int number) {
        for (const auto& i : g.neuron.initial) {
            const int state = state_named(about.type, i.state);
            initial_.emplace_back([this, &i, &g, &about, number, state] {
                plan_->first_numbers.push_back(
                    {.group = number,
                     .state = state,
                     .values = numbers(i, groups_of_.find(g.id).process, initial_stream(g.id, state),
                                       static_cast<std::size_t>(about.shape.cells))});
            });
        }
    }

    void add_initial(const model::Connection& c, const Layout::Connection& about, const ConnectionPlan& plan,
                     const connectivity::Synapses& synapses) {
        for (const auto& i : model::synapse_of(c).initial) {
            const int state = state_named(about.type, i.state);
            std::vector<std::size_t> index;  // into targets x sources
            const auto sources = static_cast<std::size_t>(layout_.groups[plan.source].shape.cells);
            for (std::size_t n = 0; i.array && n < synapses.size(); ++n)
                index.push_back(static_cast<std::size_t>(synapses.post[n]) * sources +
                                static_cast<std::size_t>(synapses.pre[n]));
            auto values = numbers(i, model::scope_of(c, groups_of_), initial_stream(c.id, state),
                                  synapses.size(), index);
            const auto none =
                std::ranges::find_if(values, [](double v) { return std::isnan(v); }) - values.begin();
            if (none < std::ssize(values))
                diagnostics_.error(
                    i.file_at,
                    fmt::format("the state '{}' of the synapse from cell {} to cell {} has no number",
                                i.state, synapses.pre[none], synapses.post[none]),
                    "only cells without a synapse may have none; cells count from 0");
            plan_->first_numbers.push_back({.connection = static_cast<int>(plan_->connections.size()) - 1,
                                            .state = state,
                                            .values = std::move(values)});
        }
    }

    /// What every cycle touches lies together: states and one row of each input that is delivered.
    void lay_out() {
        Rows& rows = plan_->rows;
        for (auto& g : plan_->groups) {
            if (g.pruned) continue;
            const auto before = rows.size();
            for (auto& s : g.states) s.first = rows.reserve(g.cells, s.depth);
            g.numbers = static_cast<Index>(rows.size() - before);
            for (std::size_t k = 0; k < max_inputs; ++k)
                if (g.fed[k]) g.inputs[k] = {rows.reserve(g.cells), 0};
        }
        for (std::size_t i = 0; i < plan_->groups.size(); ++i) {
            auto& g = plan_->groups[i];
            if (g.pruned) continue;
            for (std::size_t k = 0; k < layout_.groups[i].type.input_count(); ++k) {
                if (!g.fed[k]) g.inputs[k][0] = rows.reserve(g.cells);
                g.inputs[k][1] = g.keeps_input ? rows.reserve(g.cells) : g.inputs[k][0];
            }
            if (g.history > 0) g.past = rows.reserve(g.cells, g.history + 1);
        }
        for (std::size_t i = 0; i < plan_->modules.size(); ++i)
            for (const int g : layout_.modules[i].output_groups)
                plan_->modules[i].outputs.push_back(rows.reserve(g < 0 ? 0 : plan_->groups[g].cells));
    }

    model::Constants constants_;
    model::GroupIndex groups_of_;
    UpdateOrder order_;
    const Demand& demand_;
    const Options& options_;
    Forms forms_;
    Diagnostics& diagnostics_;
    std::shared_ptr<Plan> plan_;
    const Layout& layout_;
    Pruned pruned_;
    Budget budget_;
    std::vector<std::function<void()>> initial_;  ///< add the numbers with which groups begin
};

}  // namespace

Compiled compile(const model::System& system, std::shared_ptr<const Layout> layout, const Demand& demand,
                 const Options& options, Diagnostics& diagnostics) {
    return Compiler(system, std::move(layout), demand, options, diagnostics).run();
}

void order_steps(Plan& plan) {
    std::vector<std::vector<int>> after(plan.groups.size());
    for (int i = 0; i < std::ssize(plan.groups); ++i) {
        const auto& g = plan.groups[i];
        if (g.pruned) continue;
        if (plan.overwritten || !g.module_inputs.empty()) {
            plan.late.push_back(i);
            continue;
        }
        int last = i;
        for (const int c : g.incoming) last = std::max(last, plan.connections[c].source);
        after[last].push_back(i);
    }
    for (int i = 0; i < std::ssize(plan.groups); ++i) {
        if (plan.groups[i].pruned) continue;
        plan.steps.push_back({i, false});
        for (const int receiver : after[i]) plan.steps.push_back({receiver, true});
    }
}

}  // namespace forage::engine
