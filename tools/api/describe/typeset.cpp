#include "tools/api/describe/typeset.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "core/base/number.h"
#include "core/base/separated.h"
#include "core/equations/statements.h"
#include "core/types/parameter.h"

namespace forage {
namespace {

using equations::Statement;
using Op = Formula::Op;
using Node = Formula::Node;

constexpr std::array<std::string_view, 34> greek = {
    "alpha", "beta",  "gamma",   "delta", "epsilon", "zeta",  "eta",    "theta", "iota",
    "kappa", "mu",    "lambda",  "nu",    "xi",      "pi",    "rho",    "sigma", "tau",
    "phi",   "chi",   "upsilon", "psi",   "omega",   "Gamma", "Xi",     "Delta", "Theta",
    "Pi",    "Sigma", "Lambda",  "Phi",   "Psi",     "Omega", "Upsilon"};

/// A name without its index.
std::string typeset_letter(std::string_view name) {
    if (std::ranges::find(greek, name) != greek.end()) return fmt::format("\\{}", name);
    return name.size() == 1 ? std::string(name) : fmt::format("\\mathit{{{}}}", name);
}

std::string number_text(double value) {
    std::string text = to_text(value);
    const auto e = text.find('e');
    if (e == text.npos) return text;
    const std::string factor = text.substr(0, e);
    return fmt::format("{}10^{{{}}}", factor == "1" ? "" : factor + "\\cdot ", std::stoi(text.substr(e + 1)));
}

/// How tightly the outermost operator of a term holds it together; a part that must be `enclosed` is in
/// parentheses always.
enum class Strength { weakest, either, both, comparison, sum, product, power, atom, enclosed };

/// An operator or a function: its text around its parts, its strength, and that which each part needs.
struct TermForm {
    Op op;
    const char* text;
    Strength strength = Strength::atom;
    std::array<Strength, 3> parts = {};
};
constexpr TermForm term_forms[] = {
    {Op::add, "{} + {}", Strength::sum, {Strength::sum, Strength::product}},
    {Op::subtract, "{} - {}", Strength::sum, {Strength::sum, Strength::product}},
    {Op::power, "{}^{{{}}}", Strength::power, {Strength::atom}},
    {Op::negative, "-{}", Strength::sum, {Strength::product}},
    {Op::less, "{} < {}", Strength::comparison, {Strength::comparison, Strength::sum}},
    {Op::at_most, "{} \\le {}", Strength::comparison, {Strength::comparison, Strength::sum}},
    {Op::more, "{} > {}", Strength::comparison, {Strength::comparison, Strength::sum}},
    {Op::at_least, "{} \\ge {}", Strength::comparison, {Strength::comparison, Strength::sum}},
    {Op::equal, "{} = {}", Strength::comparison, {Strength::comparison, Strength::sum}},
    {Op::unequal, "{} \\ne {}", Strength::comparison, {Strength::comparison, Strength::sum}},
    {Op::both, "{}\\ \\text{{and}}\\ {}", Strength::both, {Strength::both, Strength::comparison}},
    {Op::either, "{}\\ \\text{{or}}\\ {}", Strength::either, {Strength::either, Strength::both}},
    {Op::inverse, "\\text{{not}}\\ {}", Strength::comparison, {Strength::atom}},
    {Op::absolute, "\\left|{}\\right|"},
    {Op::exponential, "\\exp{}", Strength::atom, {Strength::enclosed}},
    {Op::logarithm, "\\ln{}", Strength::atom, {Strength::enclosed}},
    {Op::root, "\\sqrt{{{}}}"},
    {Op::sine, "\\sin{}", Strength::atom, {Strength::enclosed}},
    {Op::cosine, "\\cos{}", Strength::atom, {Strength::enclosed}},
    {Op::hyperbolic_tangent, "\\tanh{}", Strength::atom, {Strength::enclosed}},
    {Op::clip, "\\min(\\max({}, {}), {})"},
    {Op::floor, "\\lfloor {}\\rfloor"},
    {Op::round, "\\operatorname{{round}}({})"},
    {Op::choice, "\\begin{{cases}}{1} & \\text{{if }}{0}\\\\ {2} & \\text{{otherwise}}\\end{{cases}}"},
};
static_assert(std::size(term_forms) + 6 == Formula::op_count,
              "each operator and function has a form, but for the six kinds of nodes that term() asks for");

/// A formula with this many characters is written without tall fractions and parentheses, so that TeX can
/// divide it between its terms.
constexpr std::size_t wide_formula = 60;

class Typesetter {
  public:
    explicit Typesetter(const equations::Piece& piece) : formula_(piece.text, Formula::Place::equation) {}

    std::string text() const { return of(last(), Strength::weakest); }

  private:
    struct Term {
        std::string text;
        Strength strength = Strength::atom;
    };

    const Node& node(std::uint32_t i) const { return formula_.nodes()[i]; }
    std::uint32_t last() const { return static_cast<std::uint32_t>(formula_.nodes().size() - 1); }

    static std::string in_parentheses(const std::string& text) {
        const bool tall = text.find("\\frac") != text.npos && text.size() < 2 * wide_formula;
        return tall ? "\\left(" + text + "\\right)" : "(" + text + ")";
    }
    /// The term of a node, in parentheses when its operator holds it less tightly than `needed`.
    std::string of(std::uint32_t i, Strength needed) const {
        const Term t = term(node(i));
        return t.strength < needed ? in_parentheses(t.text) : t.text;
    }
    /// The arguments of min and max, which the tree has in pairs.
    std::string arguments(const Node& n) const {
        const Node& first = node(n.parts[0]);
        return (first.op == n.op ? arguments(first) : of(n.parts[0], Strength::weakest)) + ", " +
               of(n.parts[1], Strength::weakest);
    }
    Term multiplied(const Node& n) const {
        const std::string right = of(n.parts[1], Strength::power);
        const bool digits = right.front() >= '0' && right.front() <= '9';
        return {of(n.parts[0], Strength::product) + (digits ? " \\cdot " : "\\,") + right, Strength::product};
    }
    Term divided(const Node& n) const {
        const std::string above = of(n.parts[0], Strength::weakest),
                          below = of(n.parts[1], Strength::weakest);
        if (above.size() < 2 * wide_formula)
            return {fmt::format("\\frac{{{}}}{{{}}}", above, below), Strength::power};
        return {of(n.parts[0], Strength::product) + " / " + of(n.parts[1], Strength::power),
                Strength::product};
    }

    Term term(const Node& n) const {
        if (n.op == Op::number) return {number_text(n.value), n.value < 0 ? Strength::sum : Strength::atom};
        if (n.op == Op::name) return {typeset_name(formula_.name(n))};
        if (n.op == Op::multiply) return multiplied(n);
        if (n.op == Op::divide) return divided(n);
        if (n.op == Op::minimum) return {"\\min(" + arguments(n) + ")"};
        if (n.op == Op::maximum) return {"\\max(" + arguments(n) + ")"};
        const TermForm& form = *std::ranges::find(term_forms, n.op, &TermForm::op);
        std::array<std::string, 3> parts;
        for (std::size_t i = 0; i < static_cast<std::size_t>(operands(n.op)); ++i)
            parts[i] = of(n.parts[i], form.parts[i]);
        return {fmt::format(fmt::runtime(form.text), parts[0], parts[1], parts[2]), form.strength};
    }

    Formula formula_;
};

std::string typeset_left_side(const Statement& s) {
    const std::string name = typeset_name(s.name);
    switch (s.kind) {
        case Statement::Kind::derivative:
            return fmt::format("\\frac{{\\mathrm{{d}}{}}}{{\\mathrm{{d}}t}}", name);
        case Statement::Kind::next:
            return name + "'";
        case Statement::Kind::output:
            return "\\text{output }" + name;
        case Statement::Kind::input:
            return "\\text{input }" + name;
        case Statement::Kind::value:
            break;
    }
    return name;
}

}  // namespace

std::string typeset_name(std::string_view name) {
    if (name == "normal()") return "\\mathcal{N}(0, 1)";
    if (name == "uniform()") return "\\mathcal{U}(0, 1)";
    std::string prime;
    if (name.ends_with('\'')) name.remove_suffix(1), prime = "'";
    std::vector<std::string> indices;
    if (const auto dot = name.find('.'); dot != name.npos)
        indices.emplace_back(name.substr(0, dot)), name.remove_prefix(dot + 1);
    auto end = std::min(name.find('_', 1), name.size());
    std::string_view index = name.substr(std::min(end + 1, name.size()));
    if (end == name.size()) {  // digits at its end are an index, too
        end = name.find_last_not_of("0123456789") + 1;
        index = name.substr(end);
    }
    if (!index.empty()) {
        std::string text;
        for (const char c : index) text += c == '_' ? std::string(", ") : std::string(1, c);
        indices.insert(indices.begin(), text);
    }
    const std::string base = typeset_letter(name.substr(0, end));
    return indices.empty() ? base + prime
                           : fmt::format("{}{}_{{\\mathrm{{{}}}}}", base, prime, separated(indices, ", "));
}

std::vector<std::string> typeset_equations(const std::vector<std::string>& lines) {
    const auto statements =
        equations::read_statements(separated(lines, "\n"), [](const FormulaError& e) { throw e; });
    std::vector<std::string> out;
    for (const auto& s : statements) {
        std::string right = s.formula.text.empty() ? "" : Typesetter(s.formula).text();
        std::string text = typeset_left_side(s) + (right.empty() ? "" : " = " + right);
        if (s.follows)
            out.back() += ",\\quad\\allowbreak " + text;
        else if (!s.condition.text.empty())
            out.push_back(
                fmt::format("\\text{{when }}{}\\colon\\quad {}", Typesetter(s.condition).text(), text));
        else
            out.push_back(std::move(text));
    }
    return out;
}

}  // namespace forage
