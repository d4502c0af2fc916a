#include "core/equations/statements.h"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "core/base/diagnostic.h"
#include "core/base/sequence.h"

namespace forage::equations {
namespace {

constexpr std::string_view blanks = " \t\r\n";
constexpr std::string_view operators = "+-*/^";

bool in_name(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

Piece trimmed(const Piece& p) {
    const auto first = std::min(p.text.find_first_not_of(blanks), p.text.size());
    return {p.text.substr(first, p.text.find_last_not_of(blanks) + 1 - first), p.at + first};
}
Piece part(const Piece& p, std::size_t from, std::size_t to = std::string_view::npos) {
    return trimmed({p.text.substr(from, to - from), p.at + from});
}

/// The pieces between characters that `divides` accepts outside of parentheses.
template <class Divides>
std::vector<Piece> divided(const Piece& whole, Divides divides) {
    std::vector<Piece> out;
    int depth = 0;
    std::size_t begin = 0;
    for (std::size_t i = 0; i <= whole.text.size(); ++i) {
        const bool end = i == whole.text.size();
        if (!end) depth = std::max(depth + (whole.text[i] == '(') - (whole.text[i] == ')'), 0);
        if (!end && (depth > 0 || !divides(whole.text[i]))) continue;
        if (const Piece p = part(whole, begin, i); !p.text.empty()) out.push_back(p);
        begin = i + 1;
    }
    return out;
}

/// Where a single '=' stands, which is no comparison.
std::size_t assignment_in(std::string_view text) {
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '=') continue;
        if (i + 1 < text.size() && text[i + 1] == '=')
            ++i;
        else if (i == 0 || std::string_view("<>!").find(text[i - 1]) == std::string_view::npos)
            return i;
    }
    return std::string_view::npos;
}

std::string_view word_of(std::string_view text) {
    return text.substr(0, std::ranges::find_if_not(text, in_name) - text.begin());
}
bool begins_with_word(std::string_view text, std::string_view word) { return word_of(text) == word; }

constexpr std::array<std::string_view, 3> keywords = {"when", "output", "input"};

/// A hint for the left side of an equation that is no name.
std::string hint_for_left_side(std::string_view left) {
    const std::string_view name = word_of(left);
    if (left.ends_with('\'') || (left.starts_with('d') && left.find('/') != left.npos))
        return "a derivative is written dx/dt; a second one takes two equations: dx/dt = v and dv/dt = ...";
    if (!left.empty() && operators.find(left.back()) != left.npos)
        return fmt::format("write {0}' = {0} {1} ...", name, left.back());
    if (left.find("when") != left.npos) return "when v' >= 1: v' = 0";
    return "the left side is a name: letters, digits and _, no word of the formulas";
}

constexpr const char* forms =
    "an equation is u = ..., x' = ..., dx/dt = ..., output y = ..., input v or when CONDITION: x' = ...";

/// A hint for a line that is no equation.
std::string hint_for_line(std::string_view line) {
    if (operators.find(line.front()) != operators.npos) return "a line continues while a parenthesis is open";
    for (const auto keyword : keywords)
        if (nearest(word_of(line), std::array{std::string(keyword)}) == keyword)
            return fmt::format("did you mean '{}'?", keyword);
    return forms;
}

class Reader {
  public:
    explicit Reader(const Report& report) : report_(report) {}

    std::vector<Statement> read(std::string_view text) {
        std::string without_remarks(text);
        for (std::size_t at = 0; (at = without_remarks.find('#', at)) != std::string::npos;)
            for (; at < without_remarks.size() && without_remarks[at] != '\n'; ++at)
                without_remarks[at] = ' ';
        bool open_end = false;
        for (const Piece& line : divided({without_remarks, 0}, [](char c) { return c == '\n'; })) {
            // What follows a line that ends in an operator belongs to its mistake.
            const bool continues =
                std::exchange(open_end, operators.find(line.text.back()) != operators.npos);
            if (continues && assignment_in(line.text) == std::string_view::npos &&
                !begins_with_keyword(line.text))
                continue;
            bool after_when = false;
            for (const Piece& each : divided(line, [](char c) { return c == ';'; })) {
                try {
                    if (std::exchange(after_when, false) && !begins_with_keyword(each.text))
                        throw FormulaError(each.at, "after 'when', ',' divides the changes",
                                           "what happens in every cycle stands on a line of its own");
                    statement(each);
                    after_when = is_when(each.text);
                } catch (const FormulaError& e) {
                    report_(e);
                }
            }
        }
        return std::move(out_);
    }

  private:
    static bool is_when(std::string_view text) {
        return begins_with_word(text, "when") && assignment_in(text) != word_of(text).size();
    }
    static bool begins_with_keyword(std::string_view text) { return contains(keywords, word_of(text)); }

    void statement(const Piece& line) {
        if (!is_when(line.text)) return assignment(line, {}, false);
        const auto parts = divided(line, [](char c) { return c == ':'; });
        if (parts.size() != 2)
            throw FormulaError(line.at, "'when' needs a condition, ':' and what happens then",
                               "when v' >= 30: v' = c, u' = u' + d");
        const Piece condition = part(parts[0], std::string_view("when").size());
        bool follows = false;
        for (const Piece& each : divided(parts[1], [](char c) { return c == ','; }))
            assignment(each, condition, follows), follows = true;
    }

    void assignment(const Piece& line, const Piece& condition, bool follows) {
        Statement s;
        s.condition = condition, s.follows = follows;
        const auto equals = std::min(assignment_in(line.text), line.text.size());
        Piece left = part(line, 0, equals);
        s.formula = equals < line.text.size() ? part(line, equals + 1) : Piece();
        const bool is_output = begins_with_word(left.text, "output") && left.text != "output";
        if (is_output) s.kind = Statement::Kind::output, left = part(left, word_of(left.text).size());
        const bool is_input =
            equals == line.text.size() && begins_with_word(left.text, "input") && left.text != "input";
        if (is_input) s.kind = Statement::Kind::input, left = part(left, word_of(left.text).size());
        s.at = left.at;
        if (left.text.ends_with("/dt") && left.text.starts_with('d') && !is_output) {
            s.kind = Statement::Kind::derivative;
            left.text = left.text.substr(1, left.text.size() - 1 - std::string_view("/dt").size());
        } else if (left.text.ends_with('\'')) {
            if (!is_output) s.kind = Statement::Kind::next;
            left.text.pop_back();
        }
        s.name = left.text;
        if (equals == line.text.size() && !is_output && !is_input)
            throw FormulaError(line.at, "this is no equation", hint_for_line(line.text));
        if (!is_equation_name(s.name))
            throw FormulaError(s.at, fmt::format("'{}' cannot be computed", left.text),
                               hint_for_left_side(left.text));
        if (equals < line.text.size() && s.formula.text.empty())
            throw FormulaError(line.at + equals, fmt::format("'{}' has no formula", s.name));
        if (!condition.text.empty() && (s.kind == Statement::Kind::derivative || is_output || is_input))
            throw FormulaError(s.at, "this cannot stand under 'when'", "when CONDITION: x' = ..., u = ...");
        out_.push_back(std::move(s));
    }

    const Report& report_;
    std::vector<Statement> out_;
};

}  // namespace

bool is_equation_name(std::string_view name) {
    constexpr std::array<std::string_view, 4> others = {"normal", "uniform", "nan", "inf"};
    return is_formula_name(name) && !contains(keywords, name) && !contains(others, name);
}

std::vector<Statement> read_statements(std::string_view text, const Report& report) {
    return Reader(report).read(text);
}

}  // namespace forage::equations
