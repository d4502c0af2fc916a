#include "core/equations/plugin_source.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include <fmt/format.h>

#include "core/equations/compile.h"

namespace forage::equations {
namespace {

using Kind = Statement::Kind;

/// A piece of C++, and how tightly it holds together: a sum is 4, a product 5, a call 9.
struct Code {
    std::string text;
    int rank = 9;
};

std::string at_least(const Code& c, int rank) { return c.rank < rank ? "(" + c.text + ")" : c.text; }

std::string literal(double value) {
    std::string out = fmt::format("{}", value);
    return out.find_first_of(".en") == out.npos ? out + ".0" : out;
}

/// An operator or a function in C++: its text around its parts, and how tightly it and each part, which
/// otherwise stands in parentheses, hold together.
struct CodeForm {
    Op op;
    const char* text;
    int rank = 9;
    std::array<int, 3> parts = {};
};
constexpr CodeForm code_forms[] = {
    {Op::add, "{} + {}", 4, {4, 5}},
    {Op::subtract, "{} - {}", 4, {4, 5}},
    {Op::multiply, "{} * {}", 5, {5, 6}},
    {Op::divide, "{} / {}", 5, {5, 6}},
    {Op::power, "forage::power({}, {})"},
    {Op::negative, "-{}", 6, {6}},
    {Op::less, "({} < {} ? 1.0 : 0.0)", 9, {4, 4}},
    {Op::at_most, "({} <= {} ? 1.0 : 0.0)", 9, {4, 4}},
    {Op::more, "({} > {} ? 1.0 : 0.0)", 9, {4, 4}},
    {Op::at_least, "({} >= {} ? 1.0 : 0.0)", 9, {4, 4}},
    {Op::equal, "({} == {} ? 1.0 : 0.0)", 9, {4, 4}},
    {Op::unequal, "({} != {} ? 1.0 : 0.0)", 9, {4, 4}},
    {Op::both, "({} != 0 && {} != 0 ? 1.0 : 0.0)", 9, {4, 4}},
    {Op::either, "({} != 0 || {} != 0 ? 1.0 : 0.0)", 9, {4, 4}},
    {Op::inverse, "({} == 0 ? 1.0 : 0.0)", 9, {4}},
    {Op::minimum, "std::min({}, {})"},
    {Op::maximum, "std::max({}, {})"},
    {Op::clip, "std::min(std::max({}, {}), {})"},
    {Op::choice, "({} != 0 ? {} : {})", 9, {4, 4, 4}},
    {Op::absolute, "std::abs({})"},
    {Op::exponential, "std::exp({})"},
    {Op::logarithm, "std::log({})"},
    {Op::root, "std::sqrt({})"},
    {Op::sine, "std::sin({})"},
    {Op::cosine, "std::cos({})"},
    {Op::hyperbolic_tangent, "std::tanh({})"},
    {Op::floor, "std::floor({})"},
    {Op::round, "std::round({})"},
};
static_assert(std::size(code_forms) + 2 == Formula::op_count,
              "each operator and function has a form; numbers and names are written by translated()");

/// A formula in C++; `name_of` says what its names are there.
template <class NameOf>
Code translated(const Formula& f, const Formula::Node& n, const NameOf& name_of) {
    if (n.op == Op::number) return {literal(n.value)};
    if (n.op == Op::name) return {name_of(f.name(n), n.at)};
    const CodeForm& form = *std::ranges::find(code_forms, n.op, &CodeForm::op);
    std::array<std::string, 3> parts;
    for (std::size_t i = 0; i < static_cast<std::size_t>(operands(n.op)); ++i)
        parts[i] = at_least(translated(f, f.nodes()[n.parts[i]], name_of), form.parts[i]);
    return {fmt::format(fmt::runtime(form.text), parts[0], parts[1], parts[2]), form.rank};
}

/// Writes the source.
class Writer {
  public:
    Writer(const model::TypeDeclaration& d, bool synapse) : d_(d), synapse_(synapse) {
        std::string text;
        for (const auto& piece : d.equations) text += (text.empty() ? "" : "\n") + piece.text;
        statements_ = read_statements(text, [](const FormulaError& e) { throw e; });
    }

    template <class Type>
    std::string write(const Type& type) {
        for (const auto& p : type.parameters) parameters_.insert(p.name);
        for (const auto& s : type.states) states_.insert(s.name);
        const std::string update = body();
        std::string out =
            fmt::format("// {}{}{}\n#include <algorithm>\n#include <cmath>\n\n#include <forage/plugin.h>\n\n",
                        d_.name, d_.doc.empty() ? "" : ": ", d_.doc);
        out += fmt::format("struct {} {{\n", d_.name);
        for (const auto& p : type.parameters)
            out += fmt::format("    double {} = {};\n", p.name, literal(std::get<double>(p.default_value)));
        if (uses_dt_) out += "    double dt = 0;  // s\n";
        if (draws_ > 0) out += fmt::format("    static constexpr int random_numbers = {};\n", draws_);
        out += fmt::format("\n    struct {} {{\n", synapse_ ? "Synapse" : "Cell");
        for (const auto& s : type.states)
            if (!synapse_ || !s.output)
                out += fmt::format("        double {} = {};\n", s.name, literal(s.initial));
        out += "    };\n";
        if (!targets_.empty()) {
            out += "    struct Target {\n";
            for (const auto& [member, from] : targets_)
                out += fmt::format("        double {} = 0;\n", member);
            out += "    };\n";
        }
        out += description(type);
        return out + update + fmt::format("}};\n\nFORAGE_PLUGIN({});\n", d_.name);
    }

  private:
    template <class Type>
    std::string description(const Type& type) {
        std::string out = fmt::format(
            "\n    static void describe(forage::{}Spec<{}>& s) {{\n"
            "        s.name(\"{}\", \"{}\").doc({});\n",
            synapse_ ? "Synapse" : "Neuron", d_.name, d_.name, d_.name, quoted(d_.doc));
        if constexpr (requires { type.reads; })
            for (const auto& [kind, name] : {std::pair(InputKind::excitatory, "excitatory"),
                                             {InputKind::inhibitory, "inhibitory"},
                                             {InputKind::modulatory, "modulatory"}})
                if (type.reads[static_cast<std::size_t>(kind)])
                    out += fmt::format("        s.reads(forage::InputKind::{});\n", name);
        for (const auto& p : type.parameters)
            out += fmt::format("        s.param({0}, &{4}::{1}).label({0}){2}{3};\n", quoted(p.name), p.name,
                               p.unit.empty() ? "" : ".unit(" + quoted(p.unit) + ")",
                               p.doc.empty() ? "" : ".doc(" + quoted(p.doc) + ")", d_.name);
        if (uses_dt_) out += fmt::format("        s.dt(&{}::dt);\n", d_.name);
        for (const auto& s : type.states) {
            if (synapse_ && s.output)
                out += fmt::format("        s.output({0}, {0});\n", quoted(s.name));
            else
                out += fmt::format("        s.{0}({1}, &{2}::{3}, {4});\n",
                                   synapse_   ? "state"
                                   : s.output ? "output"
                                              : "feedback",
                                   quoted(s.name), synapse_ ? "Synapse" : "Cell", s.name, quoted(s.label));
        }
        for (const auto& [member, from] : targets_)
            out += fmt::format("        s.target(&Target::{}, {}, {});\n", member, quoted(from.first),
                               from.second);
        return out + "    }\n\n";
    }

    static std::string quoted(const std::string& text) {
        std::string out = "\"";
        for (const char c : text) out += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
        return out + "\"";
    }

    std::string body() {
        std::string lines, result;
        for (const auto& s : statements_) {
            if (s.kind == Kind::input)
                throw FormulaError(s.at, "plugins have no further inputs", "they read exc, inh and mod");
            if (s.kind == Kind::output && synapse_) {
                if (s.formula.text.empty())
                    throw FormulaError(s.at, "the output of a synapse is a formula in a plugin",
                                       "output psp = ...");
                result = in_output(s);
            } else {
                lines += line(s);
            }
        }
        if (states_.contains("pre")) lines += "        now.pre = pre;\n";
        if (lines.find("old.") != lines.npos)
            lines = fmt::format("        const {} old = now;\n", synapse_ ? "Synapse" : "Cell") + lines;
        if (!synapse_)
            return fmt::format("    void update(Cell& now, const forage::Input&{}) const {{\n{}    }}\n",
                               lines.find("in.") != lines.npos ? " in" : "", lines);
        return function("void update(Synapse& now", lines, "\n", "    ") +
               function("double output(const Synapse& now", "return " + result + ";", " ", " ");
    }

    /// A function of a synapse, with names for the arguments that its lines use.
    std::string function(std::string_view head, const std::string& lines, std::string_view before,
                         std::string_view after) {
        const auto argument = [&](const char* type, std::string_view name) {
            const bool used = lines.find(name) != lines.npos;
            return fmt::format(", {}{}", type, used ? fmt::format(" {}", name) : "");
        };
        return fmt::format("    {}{}{}) const {{{}{}{}}}\n", head, argument("double", "pre"),
                           targets_.empty() ? "" : argument("const Target&", "target"), before, lines, after);
    }

    std::string line(const Statement& s) {
        std::string out;
        if (!s.condition.text.empty() && !s.follows)
            out +=
                fmt::format("        const bool {} = {} != 0;\n", when(true), at_least(code(s.condition), 4));
        const std::string indent(8, ' ');
        const std::string condition = s.condition.text.empty() ? "" : fmt::format("if ({}) ", when(false));
        if (s.formula.text.empty()) {  // output y
            if (values_.contains(s.name)) out += fmt::format("{}now.{} = {};\n", indent, s.name, s.name);
            return out;
        }
        std::string value = code(s.formula).text;
        if (s.kind == Kind::derivative)
            uses_dt_ = true, value = fmt::format("old.{} + dt * {}", s.name, at_least(code(s.formula), 6));
        if (s.kind == Kind::value) {
            const bool fresh = values_.insert(s.name).second;
            return out +
                   fmt::format("{}{}{}{} = {};\n", indent, condition, fresh ? "double " : "", s.name, value);
        }
        return out + fmt::format("{}{}now.{} = {};\n", indent, condition, s.name, value);
    }
    std::string when(bool next) { return fmt::format("when_{}", whens_ += next); }

    /// The output of a synapse, which is computed after its update.
    std::string in_output(const Statement& s) {
        in_output_ = true;
        std::string out = code(s.formula).text;
        in_output_ = false;
        return out;
    }

    Code code(const Piece& piece) {
        const Formula f(piece.text, Formula::Place::equation);
        return translated(f, f.nodes().back(), [&](const std::string& name, std::size_t at) {
            return name_of(name, piece.at + at);
        });
    }

    std::string name_of(const std::string& name, std::size_t at) {
        if (name == "normal()")
            return draws_ += 2,
                   fmt::format("forage::normal(in.random[{}], in.random[{}])", draws_ - 2, draws_ - 1);
        if (name == "uniform()") return fmt::format("in.random[{}]", draws_++);
        if (name == "dt") return uses_dt_ = true, name;
        if (name == "t")
            throw FormulaError(at, "plugins with a Cell do not see the time", "count it: time' = time + dt");
        if (!synapse_ && name == "exc") return "in.excitation";
        if (!synapse_ && name == "inh") return "in.inhibition";
        if (!synapse_ && name == "mod") return "in.modulation";
        if (synapse_ && name == "pre'") return "pre";
        if (synapse_ && name.starts_with("post")) return target(name);
        const bool primed = name.ends_with('\'');
        const std::string base = primed ? name.substr(0, name.size() - 1) : name;
        if (parameters_.contains(name) && !states_.contains(name)) return name;
        if (in_output_ && !primed)
            throw FormulaError(at, fmt::format("the output of a synapse in a plugin cannot use '{}'", name),
                               "it is computed of x' and pre'");
        if (states_.contains(base) && !values_.contains(base)) return (primed ? "now." : "old.") + base;
        return base;
    }

    /// The member of Target for post, post', post.x or post.x'.
    std::string target(const std::string& name) {
        const bool now = name.ends_with('\'');
        std::string state = name.substr(4, name.size() - 4 - now);
        if (!state.empty()) state = state.substr(1);
        const std::string member = "post" + (state.empty() ? "" : "_" + state) + (now ? "_now" : "");
        targets_[member] = {state, now ? 0 : 1};
        return "target." + member;
    }

    const model::TypeDeclaration& d_;
    bool synapse_;
    std::vector<Statement> statements_;
    std::set<std::string> parameters_, states_, values_;
    std::map<std::string, std::pair<std::string, int>> targets_;  ///< state and age, by member
    int draws_ = 0, whens_ = 0;
    bool uses_dt_ = false, in_output_ = false;
};

}  // namespace

std::string plugin_source(const model::TypeDeclaration& type, bool synapse, const Registry& registry) {
    Writer writer(type, synapse);
    return synapse ? writer.write(*registry.synapse(type.name)) : writer.write(*registry.neuron(type.name));
}

}  // namespace forage::equations
