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

/// How tightly the outermost operator of a term holds it together.
enum class Strength { weakest, either, both, comparison, sum, product, power, atom };

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
    Term pair(const Node& n, std::string_view between, Strength strength, Strength right) const {
        return {of(n.parts[0], strength) + std::string(between) + of(n.parts[1], right), strength};
    }
    Term compared(const Node& n, std::string_view sign) const {
        return pair(n, fmt::format(" {} ", sign), Strength::comparison, Strength::sum);
    }
    Term function(const Node& n, std::string_view name) const {
        return {std::string(name) + in_parentheses(of(n.parts[0], Strength::weakest))};
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
        const auto part = [&](int i) { return of(n.parts[i], Strength::weakest); };
        switch (n.op) {
            case Op::number:
                return {number_text(n.value), n.value < 0 ? Strength::sum : Strength::atom};
            case Op::name:
                return {typeset_name(formula_.name(n))};
            case Op::add:
                return pair(n, " + ", Strength::sum, Strength::product);
            case Op::subtract:
                return pair(n, " - ", Strength::sum, Strength::product);
            case Op::multiply:
                return multiplied(n);
            case Op::divide:
                return divided(n);
            case Op::power:
                return {fmt::format("{}^{{{}}}", of(n.parts[0], Strength::atom), part(1)), Strength::power};
            case Op::negative:
                return {"-" + of(n.parts[0], Strength::product), Strength::sum};
            case Op::less:
                return compared(n, "<");
            case Op::at_most:
                return compared(n, "\\le");
            case Op::more:
                return compared(n, ">");
            case Op::at_least:
                return compared(n, "\\ge");
            case Op::equal:
                return compared(n, "=");
            case Op::unequal:
                return compared(n, "\\ne");
            case Op::both:
                return pair(n, "\\ \\text{and}\\ ", Strength::both, Strength::comparison);
            case Op::either:
                return pair(n, "\\ \\text{or}\\ ", Strength::either, Strength::both);
            case Op::inverse:
                return {"\\text{not}\\ " + of(n.parts[0], Strength::atom), Strength::comparison};
            case Op::minimum:
                return {"\\min(" + arguments(n) + ")"};
            case Op::maximum:
                return {"\\max(" + arguments(n) + ")"};
            case Op::absolute:
                return {"\\left|" + part(0) + "\\right|"};
            case Op::exponential:
                return function(n, "\\exp");
            case Op::logarithm:
                return function(n, "\\ln");
            case Op::root:
                return {"\\sqrt{" + part(0) + "}"};
            case Op::sine:
                return function(n, "\\sin");
            case Op::cosine:
                return function(n, "\\cos");
            case Op::hyperbolic_tangent:
                return function(n, "\\tanh");
            case Op::clip:
                return {fmt::format("\\min(\\max({}, {}), {})", part(0), part(1), part(2))};
            case Op::floor:
                return {"\\lfloor " + part(0) + "\\rfloor"};
            case Op::round:
                return {"\\operatorname{round}(" + part(0) + ")"};
            case Op::choice:
                return {
                    fmt::format("\\begin{{cases}}{} & \\text{{if }}{}\\\\ {} & \\text{{otherwise}}"
                                "\\end{{cases}}",
                                part(1), part(0), part(2))};
        }
        return {};
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
