#include "core/model/expression.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "core/base/number.h"
#include "core/base/text_file.h"
#include "core/model/lookup.h"

namespace forage::expression {
namespace {

using model::trim;

constexpr std::string_view blanks = " \t\r\n";
constexpr const char* condition_hint =
    "for example 'trial >= 50 && Process/Group(1,1) > 0.5', 'cycle 100', '30 s'";
constexpr const char* quantity_hint = "for example 'Process/Group(1,1)', 'mean(Process/Group)', 'seconds'";
constexpr const char* source_hint =
    "for example 'Process/Group', 'Process/Group:state(1..3,1)', 'mean(Process/Group)'";

/// All positions of `wanted` outside double quotes.
std::vector<std::size_t> find_unquoted(std::string_view text, std::string_view wanted) {
    std::vector<std::size_t> out;
    bool paired = true;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '"' && paired) {
            const auto close = text.find('"', i + 1);
            if ((paired = close != text.npos)) i = close;
        } else if (text.substr(i).starts_with(wanted)) {
            out.push_back(i);
        }
    }
    return out;
}

/// Removes "3" or "3..5" from the front of a text. Returns the first number and the count of numbers, 0 for
/// an impossible range.
std::optional<std::pair<int, int>> take_range(std::string_view& rest) {
    rest = trim(rest);
    const auto first = take_number<int>(rest);
    auto last = first;
    if (rest = trim(rest); first && rest.starts_with("..")) {
        rest = trim(rest.substr(2));
        last = take_number<int>(rest), rest = trim(rest);
    }
    if (!first || !last) return std::nullopt;
    return std::pair{*first, *first < 1 || *last < *first ? 0 : *last - *first + 1};
}

/// Removes "(x1..x2,y1..y2)" from the front of a text.
std::optional<model::Region> take_cells(std::string_view& rest) {
    const auto take = [&](char c) {
        if (!rest.starts_with(c)) return false;
        rest.remove_prefix(1);
        return true;
    };
    if (!take('(')) return std::nullopt;
    const auto x = take_range(rest), y = x && take(',') ? take_range(rest) : std::nullopt;
    if (!y || !take(')')) return std::nullopt;
    return model::Region{x->first, y->first, x->second, y->second, {}};
}

/// A text that is read from its front to its end, by recursive descent.
class Parser {
  public:
    /// `hint` shows what is read.
    explicit Parser(std::string_view text, const char* hint = condition_hint)
        : text_(text.substr(0, text.find_last_not_of(blanks) + 1)), hint_(hint) {
        if (text.size() > longest) fail(fmt::format("it is longer than {} characters", longest), "", 0);
    }

    /// The end of names without quotes: one of these bytes and, in conditions, " and " and " or ".
    struct Stops {
        std::string_view bytes;
        bool words = false;
    };
    static constexpr Stops in_condition{"<>=!&|)", true};

    bool at_end() { return skip(), at_ == text_.size(); }
    std::size_t position() const { return at_; }
    std::string_view rest() const { return text_.substr(at_); }

    [[noreturn]] static void fail(const std::string& message, std::string hint, std::size_t at) {
        throw Mistake(at, message, std::move(hint));
    }

    Source source(const Stops& stops) {
        for (const auto word : reductions) {
            const bool prefix = take(std::string(word) + ":"),
                       function = !prefix && function_follows(word, stops);
            if (!prefix && !function) continue;
            if (function) take(word), take("(");
            Source out = cells_of_column(function && !stops.words ? Stops{")"} : stops);
            if (function && !take(")")) fail("a ')' is missing", "", at_);
            out.reduction = word;
            return out;
        }
        return cells_of_column(stops);
    }

    Quantity quantity() {
        if (at_end()) fail("something is missing at its end", hint_, at_);
        Quantity out;
        out.at = at_;
        if (std::string_view("+-.0123456789").find(text_[at_]) != std::string_view::npos) {
            out.value = number();
            return out;
        }
        for (const auto& [word, kind] : functions)
            if (function_follows(word, in_condition)) {
                take(word), take("(");
                out.kind = kind, out.source = cells_of_column(in_condition);
                if (!take(")")) fail("a ')' is missing", hint_, at_);
                return out;
            }
        const std::size_t before = at_;
        out.source = source(in_condition);
        out.kind = out.source.reduction.empty()     ? Quantity::cell
                   : out.source.reduction == "mean" ? Quantity::mean
                                                    : Quantity::max;
        for (const auto& [word, kind] : words)
            if (trim(text_.substr(before, at_ - before)) == word) {
                out.kind = kind;
                return out;
            }
        if (at_ == before) fail(fmt::format("'{}' is not expected here", text_.substr(at_, 1)), hint_, at_);
        return out;
    }

    Condition condition() {
        either();
        return std::move(condition_);
    }

  private:
    // Conditions are read and evaluated recursively, so their depth is limited.
    static constexpr std::size_t deepest = 100, max_parts = 1000, longest = 65536;
    using Operator = Condition::Operator;
    static constexpr std::array<std::pair<std::string_view, Quantity::Kind>, 3> words = {
        {{"cycle", Quantity::cycle}, {"trial", Quantity::trial}, {"seconds", Quantity::seconds}}};
    static constexpr std::array<std::pair<std::string_view, Quantity::Kind>, 4> functions = {
        {{"mean", Quantity::mean}, {"sum", Quantity::sum}, {"min", Quantity::min}, {"max", Quantity::max}}};

    void skip() { at_ = std::min(text_.find_first_not_of(blanks, at_), text_.size()); }
    bool take(std::string_view token) {
        skip();
        if (!rest().starts_with(token)) return false;
        at_ += token.size();
        return true;
    }
    double number() {
        skip();
        auto left = rest();
        const auto value = take_number<double>(left);
        if (!value) fail(fmt::format("'{}' is not a number", escaped(left)), hint_, at_);
        at_ = text_.size() - left.size();
        return *value;
    }
    /// Whether the next bytes cannot belong to a name.
    static bool ends(std::string_view rest, const Stops& stops) {
        rest = trim(rest);
        return rest.empty() || stops.bytes.find(rest[0]) != rest.npos ||
               (stops.words && (rest.starts_with("and ") || rest.starts_with("or ")));
    }
    static bool cells_follow(std::string_view rest, const Stops& stops) {
        return take_cells(rest) && ends(rest, stops);
    }
    /// Whether `word` with parentheses follows, and not a name or column that begins with it.
    bool function_follows(std::string_view word, const Stops& stops) {
        skip();
        if (!rest().starts_with(word)) return false;
        auto behind = trim(rest().substr(word.size()));
        if (!behind.starts_with('(') || stops.words) return behind.starts_with('(');
        if (cells_follow(behind, stops)) return false;
        std::size_t depth = 0, at = 0;
        do {
            if (behind[at] == '(') ++depth;
            if (behind[at] == ')') --depth;
        } while (++at < behind.size() && depth > 0);
        return depth == 0 && ends(behind.substr(at), stops);
    }

    Source cells_of_column(const Stops& stops) {
        skip();
        Source out;
        out.column.at = at_;
        out.column.text = column(stops);
        skip();
        if (auto behind = rest(); cells_follow(behind, stops)) {
            out.cells = take_cells(behind);
            out.cells_at = at_;
            out.cells_text = rest().substr(0, rest().size() - behind.size());
            at_ += out.cells_text.size();
        }
        return out;
    }
    /// "Process/Group:state", the name with or without quotes, up to its cells or to a stop.
    std::string column(const Stops& stops) {
        const auto close = rest().starts_with('"') ? text_.find('"', at_ + 1) : text_.npos;
        if (rest().starts_with('"') && close == text_.npos && stops.words)
            fail("a '\"' is missing", "a name in quotes ends at the second quote", at_);
        if (close == text_.npos) return name(stops);
        const auto behind = trim(text_.substr(close + 1));
        if (!stops.words && !behind.starts_with(':') && !ends(behind, stops) && !cells_follow(behind, stops))
            return name(stops);  // the quotes are part of the name
        std::string out(trim(text_.substr(at_ + 1, close - at_ - 1)));
        at_ = close + 1;
        return behind.starts_with(':') ? out + name(stops) : out;
    }
    std::string name(const Stops& stops) {
        const std::size_t begin = at_;
        for (; at_ < text_.size(); ++at_) {
            if (stops.bytes.find(text_[at_]) != stops.bytes.npos) break;
            if (stops.words && (rest().starts_with(" and ") || rest().starts_with(" or "))) break;
            if (text_[at_] != '(') continue;
            if (cells_follow(rest(), stops)) break;
            if (stops.bytes.empty()) continue;
            auto close = at_ + 1;  // parentheses may belong to the name
            while (close < text_.size() && text_[close] != '(' &&
                   stops.bytes.find(text_[close]) == stops.bytes.npos)
                ++close;
            if (close == text_.size() || text_[close] != ')') break;
            at_ = close;
        }
        return std::string(trim(text_.substr(begin, at_ - begin)));
    }

    std::size_t node(Operator op, std::size_t first, std::size_t second) {
        if (condition_.nodes.size() >= max_parts)
            fail(fmt::format("it has more than {} parts", max_parts), "", at_);
        condition_.nodes.push_back({op, first, second});
        return condition_.nodes.size() - 1;
    }
    std::size_t compare(Operator op, Quantity left, Quantity right) {
        condition_.quantities.push_back(std::move(left));
        condition_.quantities.push_back(std::move(right));
        return node(op, condition_.quantities.size() - 2, condition_.quantities.size() - 1);
    }

    std::size_t either() {
        std::size_t out = both();
        while (take("||") || take("or ")) out = node(Operator::either, out, both());
        return out;
    }
    std::size_t both() {
        std::size_t out = comparison();
        while (take("&&") || take("and ")) out = node(Operator::both, out, comparison());
        return out;
    }
    std::size_t comparison() {
        if (take("(")) {
            if (++depth_ > deepest)
                fail(fmt::format("more than {} '(' are open", deepest), condition_hint, at_ - 1);
            const std::size_t out = either();
            --depth_;
            if (!take(")")) fail("a ')' is missing", condition_hint, at_);
            return out;
        }
        if (auto time = shorthand()) return compare(Operator::at_least, *time, number_quantity());
        const std::size_t begin = at_;
        Quantity left = quantity();
        skip();
        if (left.kind == Quantity::number && rest().starts_with('s') &&
            ends(rest().substr(1), in_condition)) {
            take("s");
            if (left.value < 0) never(begin, "a run begins at 0 s");
            Quantity seconds;
            seconds.kind = Quantity::seconds, seconds.at = left.at;
            return compare(Operator::at_least, std::move(seconds), std::move(left));
        }
        if (left.kind == Quantity::number && rest().starts_with("sec"))
            fail(fmt::format("'{}' is not a unit", escaped(rest())),
                 fmt::format("write '{} s'", trim(text_.substr(begin, at_ - begin))), at_);
        static constexpr std::array<std::pair<std::string_view, Operator>, 6> operators = {
            {{"<=", Operator::at_most},
             {">=", Operator::at_least},
             {"==", Operator::equal},
             {"!=", Operator::unequal},
             {"<", Operator::less},
             {">", Operator::more}}};
        for (const auto& [sign, op] : operators)
            if (take(sign)) {
                if (const auto time = shorthand())
                    fail("there is nothing to compare in it", condition_hint, time->at);
                return compare(op, std::move(left), quantity());
            }
        static constexpr std::array<std::pair<std::string_view, std::string_view>, 3> misspelt = {
            {{"=>", ">="}, {"=<", "<="}, {"=", "=="}}};
        for (const auto& [sign, meant] : misspelt)
            if (rest().starts_with(sign))
                fail(fmt::format("'{}' is not a comparison", sign), fmt::format("write '{}'", meant), at_);
        const auto behind = trim(text_.substr(begin, at_ - begin));
        for (const auto& [word, kind] : words) {
            if (!behind.starts_with(word)) continue;
            const auto value = parse_number<double>(trim(behind.substr(word.size())));
            if (value && *value < 0)
                never(begin, kind == Quantity::trial ? "trials are counted from 1"
                                                     : "cycles and seconds are counted from 0");
        }
        fail(fmt::format("a comparison is missing behind '{}'", escaped(behind)), condition_hint, at_);
    }
    /// Refuses the time before a run that begins at `begin` and ends here.
    [[noreturn]] void never(std::size_t begin, const char* hint) {
        fail(fmt::format("'{}' is before the run", trim(text_.substr(begin, at_ - begin))), hint, begin);
    }
    /// The word of "cycle 100" or "trial 7", when only a number follows it.
    std::optional<Quantity> shorthand() {
        skip();
        for (const auto& [word, kind] : words) {
            if (kind == Quantity::seconds || !rest().starts_with(word)) continue;
            auto left = rest().substr(word.size());
            left.remove_prefix(std::min(left.find_first_not_of(' '), left.size()));
            if (left.empty() || std::string_view("0123456789.").find(left[0]) == std::string_view::npos)
                continue;
            if (!take_number<double>(left) || !ends(left, in_condition)) continue;
            Quantity out;
            out.kind = kind, out.at = at_;
            at_ += word.size();
            return out;
        }
        return std::nullopt;
    }
    Quantity number_quantity() {
        Quantity out;
        skip();
        out.at = at_, out.value = number();
        return out;
    }

    std::string_view text_;
    const char* hint_;
    std::size_t at_ = 0, depth_ = 0;
    Condition condition_;
};

/// Reads the whole text with a member function of Parser.
template <class Read>
auto whole(std::string_view text, const char* hint, Read read) {
    Parser parser(text, hint);
    auto out = read(parser);
    if (!parser.at_end())
        Parser::fail(fmt::format("'{}' is left over", parser.rest()), hint, parser.position());
    return out;
}

std::size_t offset(std::string_view piece, std::string_view text) {
    return static_cast<std::size_t>(piece.data() - text.data());
}
Piece piece(std::string_view part, std::string_view text) { return {std::string(part), offset(part, text)}; }

/// "'the text', column 7"
std::string quoted(std::string_view text, std::size_t offset) {
    constexpr std::size_t readable = 100;
    return fmt::format("'{}{}'{}", text.substr(0, readable), text.size() > readable ? "..." : "",
                       offset == 0 ? "" : fmt::format(", column {}", offset + 1));
}

/// The location of the byte `by` of an expression that begins at `at` in its file, in which XML may write
/// characters as entities.
Location shifted(const Location& at, std::string_view text, std::size_t by) {
    const std::string& file = at.file->text;
    std::size_t byte = 0;
    for (int line = 1; line < at.line && byte < file.size(); ++line)
        byte = std::min(file.find('\n', byte), file.size() - 1) + 1;
    byte += static_cast<std::size_t>(std::max(at.column - 1, 0));
    if (byte <= file.size() && file.compare(byte, by, text, 0, by) == 0)
        return location_of(at.file, byte + by);  // the usual case
    for (std::size_t i = 0; i < by; ++i) {
        if (byte >= file.size()) return at;
        const bool entity = file[byte] == '&', blank = blanks.find(file[byte]) != blanks.npos;
        if (!entity && file[byte] != text[i] && !(blank && text[i] == ' '))
            return at;  // the text differs from the file
        byte = entity ? std::min(file.find(';', byte), file.size() - 1) + 1 : byte + 1;
    }
    return location_of(at.file, byte);
}

}  // namespace

std::string Mistake::described(std::string_view text) const {
    return fmt::format("{}: {}{}{}", quoted(text, at), what(), hint.empty() ? "" : "; ", hint);
}

Location Context::place(std::size_t offset) const {
    if (!at.file) return at;
    const auto equals = value_at.file ? find_unquoted(text, "=") : std::vector<std::size_t>();
    if (equals.empty() || offset <= equals.front()) return shifted(at, text, offset);
    const auto value = equals.front() + 1;
    return shifted(value_at, text.substr(value), offset - value);
}

void Context::error(std::size_t offset, std::string message, std::string hint) const {
    diagnostics.error(place(offset),
                      fmt::format("{} {}: {}", what, quoted(text, at.file ? 0 : offset), message),
                      std::move(hint));
}

Source parse_source(std::string_view text) {
    return whole(text, source_hint, [](Parser& p) { return p.source({}); });
}
Quantity parse_quantity(std::string_view text) {
    return whole(text, quantity_hint, [](Parser& p) { return p.quantity(); });
}
Condition parse_condition(std::string_view text) {
    return whole(text, condition_hint, [](Parser& p) { return p.condition(); });
}

NameAndValue split_assignment(std::string_view text) {
    const auto all = find_unquoted(text, "=");
    if (all.empty()) return {text, {}};
    return {text.substr(0, all.front()), text.substr(all.front() + 1)};
}

Assignment parse_assignment(std::string_view text) {
    const auto [where, value] = split_assignment(text);
    const auto dot = where.rfind('.');
    auto owner = trim(where.substr(0, dot));
    if (where.size() == text.size() || dot == where.npos || owner.empty())
        Parser::fail(
            "not an assignment",
            "write Process/Group.parameter=value, for example 'Reactive Layer/Approach.threshold=0.3'", 0);
    if (owner.size() > 2 && owner.starts_with('"') && owner.ends_with('"'))
        owner = owner.substr(1, owner.size() - 2);
    return {piece(owner, text), piece(trim(where.substr(dot + 1)), text), piece(trim(value), text)};
}

model::ScheduledChange parse_change(std::string_view text) {
    const auto colons = find_unquoted(text, ": ");
    if (colons.empty())
        Parser::fail("not a condition, a colon, a blank and a change",
                     "for example 'trial >= 200: Selection/Adaptive.excGain=0'", 0);
    return {{std::string(trim(text.substr(0, colons[0])))}, {std::string(trim(text.substr(colons[0] + 1)))}};
}

std::vector<CellValue> parse_cell_values(std::string_view text) {
    constexpr const char* hint = "a list of cells with values is written '(1,1)=0.5 (2,1)=1'";
    std::vector<CellValue> out;
    auto rest = trim(text);
    do {
        const auto close = rest.find(")=");
        const auto end = std::min(rest.find_first_of(blanks, close == rest.npos ? 0 : close), rest.size());
        if (!rest.starts_with('(') || close == rest.npos)
            Parser::fail(fmt::format("'{}' is not a cell with a value", escaped(rest.substr(0, end))), hint,
                         offset(rest, text));
        auto cell = rest.substr(0, close + 1);
        Source source;
        source.cells_text = cell, source.cells_at = offset(cell, text);
        if (!(source.cells = take_cells(cell)) || !cell.empty() ||
            source.cells_text.find("..") != std::string::npos)
            Parser::fail(fmt::format("'{}' is not a cell", escaped(source.cells_text)), hint,
                         source.cells_at);
        const auto word = rest.substr(close + 2, end - close - 2);
        const auto value = parse_number<double>(word);
        if (!value) Parser::fail(no_number(word), hint, offset(word, text));
        out.push_back({std::move(source), *value});
        rest = trim(rest.substr(end));
    } while (!rest.empty());
    return out;
}

namespace {

/// The position where "(x,y)=value ..." begins. A name may contain parentheses, too.
std::size_t first_cell(std::string_view text) {
    for (auto open = text.find('('); open != text.npos; open = text.find('(', open + 1))
        if (const auto close = text.find_first_not_of("0123456789., \t+-", open + 1);
            close != text.npos && close > open + 1 && text.substr(close).starts_with(")="))
            return open;
    return text.npos;
}

void parse_option(std::string_view option, std::string_view text, model::ManipulationSpec& out) {
    const auto blank = std::min(option.find(' '), option.size());
    const std::string_view name = option.substr(0, blank), rest = trim(option.substr(blank));
    const auto amount = [&] {
        const auto value = parse_number<int>(rest);
        if (!value || *value < 1)
            Parser::fail(fmt::format("'{}' needs a whole number, at least 1", name), "",
                         offset(option, text));
        return static_cast<std::uint64_t>(*value);
    };
    if (name == "every")
        out.every = amount();
    else if (name == "step")
        out.step = amount();
    else if (name == "times")
        out.times = amount();
    else if (name == "backwards" && rest.empty())
        out.backwards = true;
    else if (name == "from" && !rest.empty())
        out.from = {std::string(rest)};
    else if (name == "until" && !rest.empty())
        out.until = {std::string(rest)};
    else
        Parser::fail(fmt::format("'{}' is not an option of a manipulation", option),
                     "options are every N, step N, times N, backwards, from WHEN, until WHEN",
                     offset(option, text));
}

}  // namespace

model::ManipulationSpec parse_manipulation(model::ManipulationSpec::Mode mode, std::string_view text) {
    model::ManipulationSpec out;
    out.mode = mode, out.text = text;
    auto semicolons = find_unquoted(text, ";");
    semicolons.push_back(text.size());
    const auto head = trim(text.substr(0, semicolons[0]));
    for (std::size_t i = 0; i + 1 < semicolons.size(); ++i)
        parse_option(trim(text.substr(semicolons[i] + 1, semicolons[i + 1] - semicolons[i] - 1)), text, out);
    if (const auto cell = first_cell(head); cell != head.npos) {
        out.group = {std::string(trim(head.substr(0, cell)))}, out.cells = {std::string(head.substr(cell))};
    } else if (const auto equals = head.rfind('='); equals != head.npos && equals > 0) {
        out.group = {std::string(trim(head.substr(0, equals)))};
        out.patterns = {std::string(trim(head.substr(equals + 1)))};
    } else if (!head.empty() && equals == head.npos) {
        out.table = {std::string(head)};
    } else {
        Parser::fail(
            "no manipulation",
            "write 'Process/Group(x,y)=value', 'Process/Group=FILE' with a list of patterns, or a table FILE",
            0);
    }
    if (!out.table.empty() && (out.every > 1 || out.step > 1 || out.times || out.backwards))
        Parser::fail("a table says itself in which cycles its rows hold", "", semicolons[0]);
    return out;
}

namespace {

constexpr std::array<std::string_view, 11> plots = {"time",    "space",      "movie",    "connection",
                                                    "diagram", "trajectory", "wiring",   "curve",
                                                    "heat",    "learning",   "occupancy"};
constexpr int max_blocks = 1000;  // lines closer than a pixel

/// "100", "0..500" or "0..500/10"; `what` they are: "cycle" or "trial"
Plot::Cycles parse_cycles(std::string_view word, std::string_view what, std::string_view text) {
    const auto read = [&](std::string_view number) {
        if (const auto value = parse_number<std::uint64_t>(trim(number))) return *value;
        Parser::fail(fmt::format("'{}' is not a {}", word, what),
                     fmt::format("{}s are N, A..B or A..B/STEP", what), offset(word, text));
    };
    const auto dots = word.find("..");
    if (dots == word.npos) return {read(word), read(word), 1};
    const auto slash = std::min(word.find('/', dots), word.size());
    const Plot::Cycles out{read(word.substr(0, dots)), read(word.substr(dots + 2, slash - dots - 2)),
                           slash < word.size() ? read(word.substr(slash + 1)) : 1};
    if (out.step == 0 || out.last < out.first) read("");
    return out;
}

}  // namespace

std::string_view Plot::name(Kind kind) { return plots[static_cast<std::size_t>(kind)]; }

Plot parse_plot(std::string_view text) {
    Plot out;
    const auto end = std::min(text.find_first_of(":@;"), text.size());
    const auto kind = trim(text.substr(0, end));
    const auto found = std::ranges::find(plots, kind);
    if (found == plots.end())
        Parser::fail(fmt::format("there is no plot '{}'", kind),
                     suggest(kind, std::vector<std::string>(plots.begin(), plots.end())), 0);
    out.kind = static_cast<Plot::Kind>(found - plots.begin());
    auto rest = text.substr(end);
    if (rest.starts_with(':')) rest.remove_prefix(1);
    if (const auto semicolons = find_unquoted(rest, ";"); !semicolons.empty()) {
        const auto option = trim(rest.substr(semicolons.back() + 1));
        const auto size =
            option.substr(std::min<std::size_t>(option.find('=') + 1, option.size()));  // npos + 1 is 0
        const auto x = std::min(size.find('x'), size.size());
        const auto across = parse_number<int>(trim(size.substr(0, x))),
                   down = parse_number<int>(trim(size.substr(std::min(x + 1, size.size()))));
        const auto sound = [](const std::optional<int>& n) { return n && *n >= 1 && *n <= max_blocks; };
        if (!option.starts_with("blocks=") || !sound(across) || !sound(down))
            Parser::fail(fmt::format("'{}' is not an option of a plot", option), "such as ';blocks=9x1'",
                         offset(option, text));
        out.blocks_across = *across, out.blocks_down = *down;
        rest = rest.substr(0, semicolons.back());
    }
    const auto ats = find_unquoted(rest, "@");
    // A connection may have an '@' in its name.
    const bool cycles = out.of_connection()
                            ? !ats.empty() && rest.substr(ats.back()).find_first_not_of("@0123456789.,/ ") ==
                                                  std::string_view::npos
                            : out.of_cells() || out.kind == Plot::Kind::trajectory;
    if (cycles && !ats.empty()) {
        auto list = rest.substr(ats.back() + 1);
        out.cycles_text = list;
        while (!list.empty()) {
            const auto comma = std::min(list.find(','), list.size());
            out.cycles.push_back(parse_cycles(list.substr(0, comma),
                                              out.kind == Plot::Kind::trajectory ? "trial" : "cycle", text));
            list.remove_prefix(std::min(comma + 1, list.size()));
        }
        rest = rest.substr(0, ats.back());
    }
    out.what = trim(rest);
    if (out.what.empty() && out.of_connection())
        Parser::fail("which connection?", fmt::format("'{}:NAME'; 'forage describe' lists them", kind), 0);
    return out;
}

}  // namespace forage::expression
