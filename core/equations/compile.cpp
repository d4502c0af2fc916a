#include "core/equations/compile.h"

#include <algorithm>
#include <array>
#include <map>
#include <numbers>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "core/base/diagnostic.h"
#include "core/formula/elsewhere.h"
#include "core/types/neuron_columns.h"

namespace forage::equations {
namespace {

using Value = Program::Value;
using Kind = Statement::Kind;

std::size_t index_of(const std::vector<std::string>& all, std::string_view name) {
    return static_cast<std::size_t>(std::ranges::find(all, name) - all.begin());
}
bool has(const std::vector<std::string>& all, std::string_view name) {
    return index_of(all, name) < all.size();
}

class Compiler {
  public:
    Compiler(const Vocabulary& names, const Report& report) : names_(names), report_(report) {
        out_.constants = names.constants;
        out_.states = names.states;
    }

    Compiled compile(std::string_view text) {
        const auto all = read_statements(text, [&](const FormulaError& e) { sound_ = false, report_(e); });
        declare(all);
        for (const Statement& s : all) {
            try {
                carry_out(s);
            } catch (const FormulaError& e) {
                report_(e);
                define(s, std::nullopt);
            }
        }
        if (all.empty() && sound_)
            report_(FormulaError(0, "there is no equation", "dx/dt = (exc - x) / tau"));
        else if (output_.empty() && sound_)
            report_(FormulaError(
                all.back().at, "the equations name no output",
                names_.synapse ? "output psp = w' * pre'" : "output x, or output y = max(x', 0)"));
        warn_of_unused();
        finish();
        return std::move(out_);
    }

  private:
    /// Finds the states and the output, which equations above may use.
    void declare(const std::vector<Statement>& all) {
        for (const auto& s : all)
            if (s.kind == Kind::value) later_.insert(s.name);
        for (const auto& s : all)
            if (s.kind == Kind::input && !names_.synapse && !reserved(s.name) &&
                out_.inputs.size() < max_inputs - input_kinds)
                out_.inputs.push_back(s.name);
        for (const auto& s : all) {
            if (s.kind == Kind::value || s.kind == Kind::input || has(out_.states, s.name)) continue;
            if (s.kind == Kind::output && s.formula.text.empty() && !later_.contains(s.name)) continue;
            out_.states.push_back(s.name);
            if (s.kind == Kind::output && s.formula.text.empty()) shown_.insert(s.name);
        }
        for (const auto& s : all)
            if (s.kind == Kind::output && output_.empty()) output_ = s.name;
    }

    bool is_state(const std::string& name) const { return has(out_.states, name) && !shown_.contains(name); }

    /// Checks a further input, which declare() has found.
    void receive(const Statement& s) {
        if (names_.synapse)
            throw FormulaError(s.at, "synapses have no inputs of their own", "they read pre and post");
        if (defined_at_.contains(s.name))
            throw FormulaError(s.at, fmt::format("there is already an input '{}'", s.name),
                               "choose another name");
        defined_at_[s.name] = s.at;
        if (!has(out_.inputs, s.name))
            throw FormulaError(s.at,
                               fmt::format("a type has at most {} further inputs", max_inputs - input_kinds));
    }

    void carry_out(const Statement& s) {
        if (s.kind == Kind::input && (has(out_.inputs, s.name) || !reserved(s.name))) return receive(s);
        if (const char* what = reserved(s.name))
            throw FormulaError(s.at, fmt::format("'{}' is {} and cannot be computed", s.name, what),
                               s.kind == Kind::output && s.formula.text.empty()
                                   ? fmt::format("output y = {}", s.name)
                                   : "choose another name");
        if (s.kind == Kind::output) return show(s);
        if (s.kind == Kind::value && is_state(s.name))
            throw FormulaError(s.at, fmt::format("'{}' is a state", s.name),
                               fmt::format("its value after the cycle is {0}': write {0}' = ...", s.name));
        auto& to = s.kind == Kind::value ? values_ : next_;
        const auto before = to.find(s.name);
        const bool twice = s.condition.text.empty() && before != to.end();
        if (twice && (!sound_ || !before->second)) return;  // reported
        if (twice)
            throw FormulaError(
                s.at, fmt::format("{} is computed twice", written(s)),
                fmt::format("a change on a condition is written when CONDITION: {} = ...", written(s)));
        look(s);
        std::optional<Value> value = formula(s.formula);
        if (s.kind == Kind::derivative)  // x' = x + dt * ...
            value = combined(Op::add, old(s.name), combined(Op::multiply, scalar("dt"), value));
        if (!s.condition.text.empty()) {
            if (!s.follows) condition_ = formula(s.condition);
            const auto otherwise =
                before != to.end() ? before->second
                : s.kind == Kind::next
                    ? old(s.name)
                    : throw FormulaError(s.at, fmt::format("'{}' has no value yet", s.name),
                                         "give it one above, for the other case");
            value = combined(Op::choice, condition_, value, otherwise);
        }
        define(s, value);
    }

    /// Notes time constants, and warns of a derivative that is written as a new value.
    void look(const Statement& s) {
        const Formula f = parsed(s.formula);
        const auto& nodes = f.nodes();
        const auto name_of = [&](const Formula::Node& n) { return n.op == Op::name ? f.name(n) : ""; };
        const bool has_dt = std::ranges::any_of(nodes, [&](const auto& n) { return name_of(n) == "dt"; });
        // Calls visit(summand, whether it is subtracted).
        const auto each_summand = [&](const auto& self, const Formula::Node& n, bool minus,
                                      const auto& visit) -> void {
            if (n.op == Op::add || n.op == Op::subtract) {
                self(self, nodes[n.parts[0]], minus, visit);
                self(self, nodes[n.parts[1]], minus != (n.op == Op::subtract), visit);
            } else if (n.op == Op::negative) {
                self(self, nodes[n.parts[0]], !minus, visit);
            } else {
                visit(n, minus);
            }
        };
        bool alone = false;  // x is a summand
        std::string tau;     // a summand is (... - x) / tau, or -x / tau
        each_summand(each_summand, nodes.back(), false, [&](const auto& n, bool outer) {
            alone |= name_of(n) == s.name;
            if (n.op != Op::divide || nodes[n.parts[1]].op != Op::name) return;
            each_summand(each_summand, nodes[n.parts[0]], outer, [&](const auto& part, bool minus) {
                if (minus && name_of(part) == s.name) tau = name_of(nodes[n.parts[1]]);
            });
        });
        if (tau.empty()) return;
        if (s.kind == Kind::derivative && has(names_.constants, tau)) out_.time_constants.push_back(tau);
        if (s.kind == Kind::next && s.condition.text.empty() && !alone && !has_dt && tau.starts_with("tau"))
            out_.warnings.emplace_back(
                s.at, fmt::format("{0}' is the value of {0} after this cycle, not its derivative", s.name),
                fmt::format("d{}/dt = {}", s.name, s.formula.text));
    }

    void define(const Statement& s, std::optional<Value> value) {
        if (s.kind == Kind::value) {
            values_[s.name] = value;
            if (!defined_at_.contains(s.name)) defined_at_[s.name] = s.at;
        } else if (has(out_.states, s.name)) {
            next_[s.name] = value;
        }
    }

    void show(const Statement& s) {
        if (s.name != output_ || std::exchange(output_seen_, true))
            throw FormulaError(s.at, fmt::format("'{}' is the output already", output_),
                               "a type has one output; other states are recorded by their names");
        if (!s.formula.text.empty()) {
            if (values_.contains(s.name) || next_.contains(s.name))
                throw FormulaError(s.at, fmt::format("{}' is computed twice", s.name),
                                   fmt::format("output {}", s.name));
            next_[s.name] = formula(s.formula);
            const Formula f = parsed(s.formula);
            for (const auto& n : f.nodes())
                if (n.op == Op::name && f.name(n) == "pre") late_output_ = s.formula.at + n.at;
        } else if (shown_.contains(s.name)) {
            if (!values_.contains(s.name))
                throw FormulaError(s.at, fmt::format("'{}' has no value yet", s.name),
                                   "name the output below its equation");
            next_[s.name] = values_.at(s.name);
        } else if (!has(out_.states, s.name)) {
            unknown(s.name, s.at);
        }
    }

    static std::string written(const Statement& s) { return s.kind == Kind::value ? s.name : s.name + "'"; }

    static bool is_input(const std::string& name) {
        return name == "exc" || name == "inh" || name == "mod" || name == "pre" || name == "post";
    }

    /// What a name that cannot be computed is; null for other names.
    const char* reserved(const std::string& name) const {
        if (has(names_.constants, name)) return "a constant of the type";
        if (name == "t" || name == "dt") return "a time";
        if (names_.synapse ? name == "pre" || name == "post"
                           : name == "exc" || name == "inh" || name == "mod")
            return "an input";
        if (has(out_.inputs, name)) return "an input";
        return nullptr;
    }

    // Values. An empty one has been reported.

    std::optional<Value> combined(Op op, std::optional<Value> a, std::optional<Value> b = Value{},
                                  std::optional<Value> c = Value{}) {
        if (!a || !b || !c) return std::nullopt;
        return out_.program.operation(op, *a, *b, *c);
    }

    static Formula parsed(const Piece& piece) {
        try {
            return Formula(piece.text, Formula::Place::equation);
        } catch (const FormulaError& e) {
            throw FormulaError(piece.at + e.at, e.what(), e.hint);
        }
    }

    std::optional<Value> formula(const Piece& piece) {
        const Formula formula = parsed(piece);
        try {
            std::vector<std::optional<Value>> values;
            for (const auto& n : formula.nodes()) {
                if (n.op == Op::number)
                    values.emplace_back(out_.program.number(n.value));
                else if (n.op == Op::name)
                    values.emplace_back(named(formula.name(n), piece.at + n.at));
                else
                    values.emplace_back(
                        combined(n.op, values[n.parts[0]], values[n.parts[1]], values[n.parts[2]]));
            }
            return values.back();
        } catch (const FormulaError& e) {
            const bool placed = dynamic_cast<const Placed*>(&e) != nullptr;
            throw FormulaError(placed ? e.at : piece.at + e.at, e.what(), e.hint);
        }
    }

    /// An error whose place is one in the equations already.
    struct Placed : FormulaError {
        using FormulaError::FormulaError;
    };

    Value column(Read read) {
        auto at = std::ranges::find(out_.reads, read);
        if (at == out_.reads.end()) at = out_.reads.insert(at, std::move(read));
        return out_.program.column(static_cast<std::size_t>(at - out_.reads.begin()));
    }
    Value old(const std::string& state) { return column({Read::Kind::state, index_of(out_.states, state)}); }
    Value draw() {
        if (out_.draws == NeuronColumns::draws_kept)
            throw FormulaError(
                0, fmt::format("a type draws at most {} numbers per cell", NeuronColumns::draws_kept),
                "normal() draws two, uniform() one; a value can be used several times");
        return column({Read::Kind::draw, out_.draws++});
    }
    /// The scalar of this name; the order of the scalars is final at the end.
    Value scalar(const std::string& name) {
        if (name == "t") out_.uses_time = true;
        if (name == "dt" || name == "t") return out_.program.scalar(name == "dt" ? 0 : 1);
        if (!has(out_.constants, name)) out_.constants.push_back(name);
        return out_.program.scalar(2 + index_of(out_.constants, name));
    }

    std::optional<Value> named(const std::string& name, std::size_t at) {
        seen_.insert(name);
        if (name == "normal()" || name == "uniform()") {
            if (names_.synapse)
                throw Placed(at, "synapses draw no random numbers",
                             "a neuron type can, and show them as a state");
            if (name == "uniform()") return draw();
            const Value u = draw(), v = draw();  // Box and Muller, as normal() of the SDK
            auto& p = out_.program;
            const Value radius = p.operation(
                Op::root, p.operation(Op::multiply, p.number(-2),
                                      p.operation(Op::logarithm, p.operation(Op::subtract, p.number(1), u))));
            return p.operation(
                Op::multiply, radius,
                p.operation(Op::cosine, p.operation(Op::multiply, p.number(2 * std::numbers::pi), v)));
        }
        if (names_.synapse)
            if (name == "pre") return source_before();
        if (names_.synapse)
            if (auto other = other_end(name)) return column(*std::move(other));
        if (names_.synapse && name.starts_with("pre."))
            throw Placed(at, "synapses read the output of their source, no other state", "write pre or pre'");
        if (name.find('.') != std::string::npos) unknown(name, at);
        if (name.ends_with('\'')) return after(name.substr(0, name.size() - 1), at);
        if (is_state(name)) return old(name);
        if (values_.contains(name)) return values_.at(name);
        if (has(names_.constants, name) || name == "dt" || (name == "t" && !names_.synapse))
            return scalar(name);
        if (!names_.synapse) {
            if (name == "exc") return column({Read::Kind::exc});
            if (name == "inh") return column({Read::Kind::inh});
            if (name == "mod") return column({Read::Kind::mod});
            if (has(out_.inputs, name)) return column({Read::Kind::input, index_of(out_.inputs, name)});
        }
        if (has(names_.outer, name)) return scalar(name);
        unknown(name, at);
    }

    /// A state after this cycle.
    std::optional<Value> after(const std::string& state, std::size_t at) {
        if (const auto it = next_.find(state); it != next_.end()) return it->second;
        if (is_state(state))
            throw Placed(at, fmt::format("{}' is not computed yet", state),
                         fmt::format("its equation belongs above; {} is its value before this cycle", state));
        if (values_.contains(state))
            throw Placed(at, fmt::format("'{0}' is no state, so there is no {0}'", state),
                         fmt::format("write {}", state));
        unknown(state, at);
    }

    /// The source's output in the last cycle, which each synapse keeps.
    Value source_before() {
        if (!has(out_.states, "pre")) {
            out_.states.emplace_back("pre");
            next_["pre"] = column({Read::Kind::pre_now});
        }
        return old("pre");
    }

    /// What a rule of synapses reads of its source or target; empty for another name.
    static std::optional<Read> other_end(std::string name) {
        const bool now = name.ends_with('\'');
        if (now) name.pop_back();
        if (name == "pre") return Read{Read::Kind::pre_now};
        const auto kind = now ? Read::Kind::post_now : Read::Kind::post;
        if (name == "post") return Read{kind};
        if (name.starts_with("post.")) return Read{kind, 0, name.substr(std::string_view("post.").size())};
        return std::nullopt;
    }

    [[noreturn]] void unknown(const std::string& name, std::size_t at) const {
        if (later_.contains(name))
            throw Placed(at, fmt::format("'{}' is computed below", name),
                         "equations are carried out from top to bottom: its equation belongs above");
        std::vector<std::string> known = out_.states;
        for (const auto& s : out_.states)
            if (next_.contains(s)) known.push_back(s + "'");
        for (const auto& [value, computed] : values_) known.push_back(value);
        known.insert(known.end(), out_.inputs.begin(), out_.inputs.end());
        known.insert(known.end(), names_.constants.begin(), names_.constants.end());
        for (const char* input : names_.synapse ? std::array{"pre", "pre'", "post", "post'", "dt"}
                                                : std::array{"exc", "inh", "mod", "t", "dt"})
            known.emplace_back(input);
        known.insert(known.end(), names_.outer.begin(), names_.outer.end());
        std::string hint = suggest(name, known);
        if (nearest(name, known).empty())
            hint = names_.synapse && name == "t" ? "t is for neurons; the target can pass it on: post.x"
                   : is_input(name)
                       ? (names_.synapse ? "a synapse reads pre and post" : "a neuron reads exc, inh and mod")
                   : is_unit(name) ? fmt::format("units are numbers that you name: {} = ...", name)
                   : names_.synapse && name == "weight"
                       ? "a state has a first value: <State name=\"weight\" value=\"1\"/>"
                   : sound_ && is_equation_name(name)
                       ? fmt::format("{}; a constant of its own is <Constant name=\"{}\" value=\"...\"/>",
                                     hint, name)
                       : hint;
        throw Placed(at, fmt::format("there is no '{}' in these equations", name), hint);
    }

    void warn_of_unused() {
        for (const auto& [name, at] : defined_at_)
            if (!seen_.contains(name) && !shown_.contains(name))
                out_.warnings.emplace_back(at, fmt::format("nothing uses '{}'", name));
        if (names_.synapse && late_output_ && !seen_.contains("pre'"))
            out_.warnings.emplace_back(*late_output_,
                                       "this output arrives a cycle later than that of other types",
                                       "pre' is the source's output of this cycle, pre that of the last one");
        for (const auto* names : {&names_.constants, &names_.states})
            for (const auto& name : *names)
                if (!seen_.contains(name) && !next_.contains(name)) out_.unused.push_back(name);
    }

    void finish() {
        for (std::size_t s = 0; s < out_.states.size(); ++s)
            if (const auto it = next_.find(out_.states[s]); it != next_.end() && it->second) {
                out_.program.write(*it->second);
                out_.written.push_back(s);
            } else {
                out_.kept.push_back(s);
            }
        out_.output = index_of(out_.states, output_);
        out_.program.finish();
    }

    const Vocabulary& names_;
    const Report& report_;
    Compiled out_;
    std::map<std::string, std::optional<Value>> values_, next_;
    std::map<std::string, std::size_t> defined_at_;
    bool sound_ = true;            ///< all lines are equations
    std::set<std::string> later_;  ///< all values, also of equations below
    std::set<std::string> shown_;  ///< values that `output` makes states
    std::set<std::string> seen_;   ///< names that formulas use
    std::string output_;
    bool output_seen_ = false;
    std::optional<Value> condition_;
    std::optional<std::size_t> late_output_;  ///< where it uses the source's last output
};

}  // namespace

Compiled compile(std::string_view text, const Vocabulary& names, const Report& report) {
    return Compiler(names, report).compile(text);
}

}  // namespace forage::equations
