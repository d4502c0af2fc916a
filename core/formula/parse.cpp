// The grammar of formulas (docs/reference/expressions.md), by recursive descent.
#include <algorithm>
#include <array>
#include <numbers>
#include <optional>

#include <fmt/format.h>

#include "core/base/diagnostic.h"
#include "core/base/number.h"
#include "core/formula/elsewhere.h"
#include "core/formula/formula.h"

namespace forage {
namespace {

using Op = Formula::Op;
using Node = Formula::Node;

struct Function {
    std::string_view name;
    Op op;
    std::size_t least, most;  ///< the number of its arguments
};
constexpr std::size_t any_number = 64;
constexpr std::array functions = {Function{"min", Op::minimum, 2, any_number},
                                  Function{"max", Op::maximum, 2, any_number},
                                  Function{"abs", Op::absolute, 1, 1},
                                  Function{"exp", Op::exponential, 1, 1},
                                  Function{"log", Op::logarithm, 1, 1},
                                  Function{"sqrt", Op::root, 1, 1},
                                  Function{"sin", Op::sine, 1, 1},
                                  Function{"cos", Op::cosine, 1, 1},
                                  Function{"tanh", Op::hyperbolic_tangent, 1, 1},
                                  Function{"clip", Op::clip, 3, 3},
                                  Function{"floor", Op::floor, 1, 1},
                                  Function{"round", Op::round, 1, 1},
                                  Function{"if", Op::choice, 3, 3}};

/// Random numbers of a cell, new in each cycle.
constexpr std::array<std::string_view, 2> draws = {"normal", "uniform"};

struct Operator {
    std::string_view text;
    Op op;
};
// Of two that begin alike, the longer one stands first.
constexpr std::array either = {Operator{"or", Op::either}, Operator{"||", Op::either}};
constexpr std::array both = {Operator{"and", Op::both}, Operator{"&&", Op::both}};
constexpr std::array comparisons = {Operator{"<=", Op::at_most},  Operator{"<", Op::less},
                                    Operator{">=", Op::at_least}, Operator{">", Op::more},
                                    Operator{"==", Op::equal},    Operator{"!=", Op::unequal}};
constexpr std::array sums = {Operator{"+", Op::add}, Operator{"-", Op::subtract}};
constexpr std::array products = {Operator{"*", Op::multiply}, Operator{"/", Op::divide}};

bool begins_name(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool continues_name(char c) { return begins_name(c) || (c >= '0' && c <= '9'); }

class Parser {
  public:
    Parser(std::string_view text, Formula::Place place, std::vector<Node>& nodes,
           std::vector<std::string>& names)
        : text_(text), in_equation_(place == Formula::Place::equation), nodes_(nodes), names_(names) {
        constexpr std::size_t longest = 4096;
        if (text.size() > longest)
            fail(0, fmt::format("it is longer than {} characters", longest), "use constants for its parts");
    }

    void whole() {
        alternatives();
        if (!at_end()) unexpected();
    }

  private:
    [[noreturn]] static void fail(std::size_t at, const std::string& message, std::string hint = {}) {
        throw FormulaError(at, message, std::move(hint));
    }
    [[noreturn]] void unexpected() {
        const std::string_view rest = text_.substr(at_);
        if (rest.starts_with("**")) fail(at_, "'**' is not expected here", hint_for_text(rest, in_equation_));
        if (const auto next = word(at_); next == "if" || next == "else")
            fail(at_, fmt::format("'{}' is not expected here", next), hint_for_text("?", in_equation_));
        if (begins_name(rest.front()) || rest.starts_with('('))
            fail(at_, fmt::format("an operator is missing before '{}'", word(at_)),
                 "a product is written a * b");
        fail(at_, fmt::format("'{}' is not expected here", printable_piece()),
             hint_for_text(rest, in_equation_));
    }
    std::string printable_piece() const {
        std::size_t end = at_ + 1;  // a whole character of UTF-8
        while (end < text_.size() && (static_cast<unsigned char>(text_[end]) & 0xC0) == 0x80) ++end;
        return std::string(text_.substr(at_, end - at_));
    }
    std::string word(std::size_t at) const {
        std::size_t end = at;
        while (end < text_.size() && continues_name(text_[end])) ++end;
        return std::string(text_.substr(at, std::max<std::size_t>(end - at, 1)));
    }

    bool at_end() {
        at_ = std::min(text_.find_first_not_of(" \t\r\n", at_), text_.size());
        return at_ == text_.size();
    }
    bool take(std::string_view token) {
        at_end();
        if (!text_.substr(at_).starts_with(token)) return false;
        const std::size_t after = at_ + token.size();
        if (begins_name(token.front()) && after < text_.size() && continues_name(text_[after])) return false;
        at_ = after;
        return true;
    }
    template <std::size_t n>
    std::optional<Op> take_one_of(const std::array<Operator, n>& all) {
        if (at_end() || text_.substr(at_).starts_with("**")) return std::nullopt;
        for (const auto& o : all)
            if (take(o.text)) return o.op;
        return std::nullopt;
    }

    std::uint32_t add(Op op, std::size_t at, std::uint32_t a = 0, std::uint32_t b = 0, std::uint32_t c = 0,
                      double value = 0) {
        nodes_.push_back({op, static_cast<std::uint32_t>(at), {a, b, c}, value});
        return static_cast<std::uint32_t>(nodes_.size() - 1);
    }

    /// Operands of equal rank, from left to right.
    template <std::size_t n>
    std::uint32_t joined(const std::array<Operator, n>& operators, std::uint32_t (Parser::*operand)()) {
        std::uint32_t out = (this->*operand)();
        for (std::size_t at = (at_end(), at_); const auto op = take_one_of(operators); at = (at_end(), at_))
            out = add(*op, at, out, (this->*operand)());
        return out;
    }
    std::uint32_t alternatives() {
        return nested([&] { return joined(either, &Parser::conditions); });
    }
    std::uint32_t conditions() { return joined(both, &Parser::condition); }
    std::uint32_t condition() {
        if (at_end() || !take("not")) return comparison();
        return add(Op::inverse, at_, nested([&] { return condition(); }));
    }
    std::uint32_t comparison() {
        const auto first = sum();
        at_end();
        const std::size_t at = at_;
        const auto op = take_one_of(comparisons);
        if (!op) return first;
        const auto out = add(*op, at, first, sum());
        at_end();
        if (const std::size_t again = at_; take_one_of(comparisons))
            fail(again, "comparisons cannot be chained", "write 'a < b and b < c'");
        return out;
    }
    std::uint32_t sum() { return joined(sums, &Parser::product); }
    std::uint32_t product() { return joined(products, &Parser::signed_one); }
    std::uint32_t signed_one() {
        at_end();
        const std::size_t at = at_;
        if (take("-")) return add(Op::negative, at, nested([&] { return signed_one(); }));
        if (take("+")) return nested([&] { return signed_one(); });
        return power();
    }
    std::uint32_t power() {
        const auto base = one();
        at_end();
        const std::size_t at = at_;
        if (!take("^")) return base;
        return add(Op::power, at, base, nested([&] { return signed_one(); }));  // 2^3^2 = 2^9, 2^-1 = 0.5
    }
    template <class Read>
    std::uint32_t nested(Read read) {
        constexpr int deepest = 100;  // a formula is read and computed recursively
        if (++depth_ > deepest) fail(at_, fmt::format("it is nested more than {} times", deepest));
        const auto out = read();
        --depth_;
        return out;
    }

    std::uint32_t one() {
        if (at_end())
            fail(at_, "something is missing at its end",
                 in_equation_ ? "a line continues while a parenthesis is open" : "");
        const std::size_t at = at_;
        if (take("(")) {
            const auto out = alternatives();
            if (!take(")")) at_end() ? fail(at, "this '(' is not closed") : unexpected();
            return out;
        }
        if (begins_name(text_[at])) return named();
        std::string_view rest = text_.substr(at);
        if (rest.front() == '.' || (rest.front() >= '0' && rest.front() <= '9'))
            if (const auto number = take_number<double>(rest)) {
                at_ = text_.size() - rest.size();
                return add(Op::number, at, 0, 0, 0, *number);
            }
        unexpected();
    }

    std::uint32_t named() {
        const std::size_t at = at_;
        std::string name = word(at);
        at_ += name.size();
        if (take("(")) return call(name, at);
        if (in_equation_) {
            if (text_.substr(at_).starts_with('.') && at_ + 1 < text_.size() && begins_name(text_[at_ + 1])) {
                const std::string state = word(at_ + 1);
                at_ += 1 + state.size();
                return add_name(name + "." + state + prime(), at);
            }
            name += prime();
            if (name.ends_with('\'')) return add_name(name, at);
        }
        if (name == "pi") return add(Op::number, at, 0, 0, 0, std::numbers::pi);
        if (!is_formula_name(name))
            fail(at, fmt::format("'{}' is not expected here", name),
                 std::ranges::find(functions, name, &Function::name) == functions.end()
                     ? ""
                     : fmt::format("its arguments stand in parentheses: {}(...)", name));
        return add_name(name, at);
    }
    std::uint32_t add_name(const std::string& name, std::size_t at) {
        names_.push_back(name);
        return add(Op::name, at, static_cast<std::uint32_t>(names_.size() - 1));
    }
    std::string prime() {
        if (!text_.substr(at_).starts_with('\'')) return {};
        ++at_;
        return "'";
    }

    std::uint32_t call(const std::string& name, std::size_t at) {
        if (in_equation_ && std::ranges::find(draws, name) != draws.end()) {
            if (!take(")")) fail(at, name + " has no arguments", "its numbers are scaled: m + s * normal()");
            return add_name(name + "()", at);
        }
        const auto* const f = std::ranges::find(functions, name, &Function::name);
        if (f == functions.end()) {
            std::vector<std::string> known;
            if (in_equation_) known.assign(draws.begin(), draws.end());
            for (const auto& each : functions) known.emplace_back(each.name);
            std::string hint = hint_for_function(name);
            if (in_equation_ && take("t")) hint = fmt::format("its value in this cycle is written {}", name);
            fail(at, fmt::format("there is no function '{}'", name),
                 hint.empty() ? suggest(name, known) : hint);
        }
        std::vector<std::uint32_t> arguments;
        if (!take(")")) {
            do arguments.push_back(alternatives());
            while (arguments.size() < any_number && take(","));
            if (!take(")")) at_end() ? fail(at, fmt::format("the ')' of {} is missing", name)) : unexpected();
        }
        if (arguments.size() < f->least || arguments.size() > f->most)
            fail(
                at,
                fmt::format("{} has {} argument{} instead of {}{}", name, arguments.size(),
                            arguments.size() == 1 ? "" : "s", f->least, f->most > f->least ? " or more" : ""),
                f->op == Op::choice ? "if(condition, a, b)"
                : f->op == Op::clip ? "clip(x, low, high)"
                                    : "");
        if (f->most == any_number) {
            std::uint32_t out = arguments[0];
            for (std::size_t i = 1; i < arguments.size(); ++i) out = add(f->op, at, out, arguments[i]);
            return out;
        }
        arguments.resize(3);
        return add(f->op, at, arguments[0], arguments[1], arguments[2]);
    }

    std::string_view text_;
    bool in_equation_;
    std::vector<Node>& nodes_;
    std::vector<std::string>& names_;
    std::size_t at_ = 0;
    int depth_ = 0;
};

}  // namespace

Formula::Formula(std::string_view text, Place place) { Parser(text, place, nodes_, names_).whole(); }

bool is_formula_name(std::string_view name) {
    constexpr std::array<std::string_view, 4> words = {"and", "or", "not", "pi"};
    return !name.empty() && begins_name(name.front()) && std::ranges::all_of(name, continues_name) &&
           std::ranges::find(words, name) == words.end() &&
           std::ranges::find(functions, name, &Function::name) == functions.end();
}

}  // namespace forage
