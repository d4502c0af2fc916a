#include <algorithm>
#include <array>
#include <charconv>

#include <fmt/format.h>

#include "core/model/lookup.h"
#include "core/observe/cell.h"
#include "core/observe/condition.h"

namespace forage::observe {

/// By recursive descent. Throws Mistake, and reports by itself what find_column() and find_cell() find.
class ConditionParser {
  public:
    struct Mistake {
        std::string message, hint;
    };
    ConditionParser(const engine::Layout& layout, bool trials, std::string_view text, std::string_view what,
                    Diagnostics& diagnostics, Location at)
        : layout_(layout),
          trials_(trials),
          rest_(text),
          what_(fmt::format(
              "{} '{}'", what,
              text.size() > readable ? std::string(text.substr(0, readable)) + "..." : std::string(text))),
          diagnostics_(diagnostics),
          at_(std::move(at)) {}

    std::optional<Condition> condition() {
        if (!whole([this] { either(); })) return std::nullopt;
        return std::move(out_);
    }
    std::optional<Quantity> quantity() {
        std::optional<Quantity> out;
        if (!whole([&] { out = operand(); })) return std::nullopt;
        return out;
    }

  private:
    using Node = Condition::Node;
    using Operator = Condition::Operator;

    static std::string form() {
        return "for example 'trial >= 50 && Process/Group(1,1) > 0.5', 'cycle 100', '30 s'";
    }

    /// Reads the whole text; false when there was an error.
    template <class Read>
    bool whole(Read read) {
        const int errors_before = diagnostics_.errors();
        try {
            if (rest_.size() > longest)
                throw Mistake{fmt::format("it is longer than {} characters", longest), ""};
            read();
            if (!peek().empty()) throw Mistake{fmt::format("'{}' is left over", rest_), form()};
        } catch (const Mistake& m) {
            if (diagnostics_.errors() == errors_before)  // else it may come of what was reported
                diagnostics_.error(at_, what_ + ": " + m.message, m.hint);
        }
        return diagnostics_.errors() == errors_before;
    }

    std::string_view peek() { return rest_ = model::trim(rest_); }
    bool take(std::string_view token) {
        if (!peek().starts_with(token)) return false;
        rest_.remove_prefix(token.size());
        return true;
    }
    /// A name that stands without quotes.
    std::string_view take_name() {
        peek();
        std::size_t length = rest_.size();
        for (const auto end : {rest_.find_first_of(stops), rest_.find(" and "), rest_.find(" or ")})
            length = std::min(length, end);
        const auto out = rest_.substr(0, length);
        rest_.remove_prefix(length);
        return model::trim(out);
    }
    std::string_view take_until(std::string_view ends) {
        peek();
        const auto length = std::min(rest_.find_first_of(ends), rest_.size());
        const auto out = rest_.substr(0, length);
        rest_.remove_prefix(length);
        return model::trim(out);
    }
    std::size_t add(Node node) {
        if (out_.nodes_.size() >= most_parts)
            throw Mistake{fmt::format("it has more than {} parts", most_parts), ""};
        out_.nodes_.push_back(std::move(node));
        return out_.nodes_.size() - 1;
    }

    std::size_t compare(Operator op, Quantity left, Quantity right) {
        Node node;
        node.op = op, node.left = std::move(left), node.right = std::move(right);
        return add(std::move(node));
    }
    std::size_t join(Operator op, std::size_t first, std::size_t second) {
        Node node;
        node.op = op, node.first = first, node.second = second;
        return add(std::move(node));
    }

    std::size_t either() {
        std::size_t out = both();
        while (take("||") || take("or ")) {
            out = join(Operator::either, out, both());
        }
        return out;
    }
    std::size_t both() {
        std::size_t out = comparison();
        while (take("&&") || take("and ")) {
            out = join(Operator::both, out, comparison());
        }
        return out;
    }
    std::size_t comparison() {
        if (take("(")) {
            if (++depth_ > deepest) throw Mistake{fmt::format("more than {} '(' are open", deepest), form()};
            const std::size_t out = either();
            --depth_;
            if (!take(")")) throw Mistake{"a ')' is missing", form()};
            return out;
        }
        Quantity left = operand();
        if (shorthand_) {
            shorthand_ = false;
            return compare(Operator::at_least, std::move(left), number());
        }
        if (left.kind == Quantity::number &&
            (peek() == "s" || rest_.starts_with("s ") || rest_.starts_with("s)"))) {
            take("s");
            Quantity seconds;
            seconds.kind = Quantity::seconds;
            return compare(Operator::at_least, std::move(seconds), std::move(left));
        }
        static constexpr std::array<std::pair<std::string_view, Operator>, 6> operators = {
            {{"<=", Operator::at_most},
             {">=", Operator::at_least},
             {"==", Operator::equal},
             {"!=", Operator::unequal},
             {"<", Operator::less},
             {">", Operator::more}}};
        for (const auto& [sign, op] : operators)
            if (take(sign)) {
                Quantity right = operand();
                if (shorthand_) throw Mistake{"there is nothing to compare in it", form()};
                return compare(op, std::move(left), std::move(right));
            }
        throw Mistake{peek().starts_with("=") ? "'=' is not a comparison" : "a comparison is missing",
                      peek().starts_with("=") ? "write '=='" : form()};
    }

    Quantity operand() {
        if (peek().empty()) throw Mistake{"something is missing at its end", form()};
        if (std::string_view("+-.0123456789").find(rest_.front()) != std::string_view::npos) return number();
        if (take("\"")) {
            const std::string_view name = take_until("\"");
            if (!take("\"")) throw Mistake{"a '\"' is missing", ""};
            return cell(name);
        }
        const std::string_view before = rest_, name = take_name();
        for (const auto& [word, kind] : words)
            if (name == word)
                return variable(word, kind);
            else if (kind != Quantity::seconds && name.starts_with(word) &&
                     std::string_view(" 0123456789").find(name[word.size()]) != std::string_view::npos &&
                     name.find_first_not_of(" 0123456789.", word.size()) == std::string_view::npos) {
                shorthand_ = true;
                rest_ = before.substr(word.size());
                return variable(word, kind);
            }
        for (const auto& [word, kind] : functions)
            if (name == word && peek().starts_with("(")) return function(kind);
        if (name.empty()) throw Mistake{fmt::format("'{}' is not expected here", rest_.substr(0, 1)), form()};
        return cell(name);
    }
    Quantity number() {
        double value = 0;
        if (!peek().empty() && rest_.front() == '+') rest_.remove_prefix(1);
        const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
        if (error != std::errc{}) throw Mistake{fmt::format("'{}' is not a number", rest_), form()};
        rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
        return {Quantity::number, value, {}, 0};
    }
    Quantity variable(std::string_view word, Quantity::Kind kind) const {
        if (kind == Quantity::trial && !trials_)
            throw Mistake{fmt::format("this run has no '{}'", word),
                          "trials are those of a robot that its world puts back to the start"};
        return {kind, 0, {}, 0};
    }
    Quantity function(Quantity::Kind kind) {
        take("(");
        const bool quoted = take("\"");
        const std::string_view name = quoted ? take_until("\"") : take_name();
        if ((quoted && !take("\"")) || !take(")")) throw Mistake{"a ')' is missing", form()};
        return {kind, 0, column(name), 0};
    }
    Quantity cell(std::string_view name) {
        Quantity out{Quantity::cell, 0, column(name), 0};
        const int cells = layout_.groups[out.column.group].shape.cells;
        if (take("(")) {
            const auto place = parse_cell(take_until(")"));
            if (!place || !take(")")) throw Mistake{"a cell is '(x,y)', two whole numbers", form()};
            if (found_)
                out.index = find_cell(layout_, out.column.group, place->first, place->second, what_,
                                      diagnostics_, at_)
                                .value_or(0);
        } else if (found_ && cells != 1) {
            throw Mistake{fmt::format("'{}' has {} cells", name, cells),
                          fmt::format("name one, '{0}(1,1)', or write mean({0}) or max({0})", name)};
        }
        return out;
    }
    ColumnRef column(std::string_view name) {
        const auto out = find_column(layout_, name, what_ + ":", diagnostics_, at_);
        found_ = out.has_value();
        return out.value_or(ColumnRef{});
    }

    // Conditions are read and evaluated by recursion.
    static constexpr std::size_t deepest = 100, most_parts = 1000, longest = 65536, readable = 100;
    static constexpr std::string_view stops = "<>=!&|()";
    static constexpr std::array<std::pair<std::string_view, Quantity::Kind>, 3> words = {
        {{"cycle", Quantity::cycle}, {"trial", Quantity::trial}, {"seconds", Quantity::seconds}}};
    static constexpr std::array<std::pair<std::string_view, Quantity::Kind>, 4> functions = {
        {{"mean", Quantity::mean}, {"sum", Quantity::sum}, {"min", Quantity::min}, {"max", Quantity::max}}};

    const engine::Layout& layout_;
    bool trials_;
    std::string_view rest_;
    std::string what_;
    Diagnostics& diagnostics_;
    Location at_;
    Condition out_;
    std::size_t depth_ = 0;   ///< of parentheses that are open
    bool shorthand_ = false;  ///< the operand that was just read is followed by the number it is to reach
    bool found_ = false;      ///< the column that was just named is there
};

std::optional<Condition> parse_condition(const engine::Layout& layout, bool trials, std::string_view text,
                                         std::string_view what, Diagnostics& diagnostics, Location at) {
    return ConditionParser(layout, trials, text, what, diagnostics, std::move(at)).condition();
}

std::optional<Quantity> parse_quantity(const engine::Layout& layout, bool trials, std::string_view text,
                                       std::string_view what, Diagnostics& diagnostics, Location at) {
    return ConditionParser(layout, trials, text, what, diagnostics, std::move(at)).quantity();
}

}  // namespace forage::observe
