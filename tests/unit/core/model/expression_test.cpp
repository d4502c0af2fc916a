#include "core/model/expression.h"

#include <fstream>
#include <functional>
#include <map>

#include "core/formula/formula.h"
#include "core/model/world_change.h"
#include "tests/support/catch.h"
#include "tests/support/paths.h"

using namespace forage;
using namespace forage::expression;
using Mode = model::ManipulationSpec::Mode;

namespace {

/// The meaning of a text in one line, or "column: reason" for a text that is not an expression.
template <class Parse>
std::string said(Parse parse, const std::string& text) {
    try {
        return parse(text);
    } catch (const Mistake& m) {
        return std::to_string(m.at + 1) + ": " + m.what();
    }
}

std::string source(const std::string& text) {
    return said([](const std::string& t) { return parse_source(t).text(); }, text);
}
std::string quantity(const Quantity& q) {
    static const char* names[] = {"", "cycle", "trial", "seconds", "", "mean", "sum", "min", "max"};
    if (q.kind == Quantity::number) return std::to_string(q.value).substr(0, 4);
    auto cells = q.source;
    cells.reduction = {};
    return q.kind == Quantity::cell
               ? cells.text()
               : names[q.kind] + (q.kind > Quantity::cell ? "(" + cells.text() + ")" : "");
}
std::string condition(const std::string& text) {
    return said(
        [](const std::string& t) {
            static const char* signs[] = {" < ", " <= ", " > ", " >= ", " == ", " != ", " and ", " or "};
            const Condition c = parse_condition(t);
            const std::function<std::string(std::size_t)> node = [&](std::size_t i) {
                const auto& n = c.nodes[i];
                const bool joined = n.op >= Condition::Operator::both;
                const auto part = [&](std::size_t p) { return joined ? node(p) : quantity(c.quantities[p]); };
                return "(" + part(n.first) + signs[static_cast<int>(n.op)] + part(n.second) + ")";
            };
            return node(c.nodes.size() - 1);
        },
        text);
}
std::string assignment(const std::string& text) {
    return said(
        [](const std::string& t) {
            const auto a = parse_assignment(t);
            return a.owner.text + "|" + a.parameter.text + "|" + a.value.text;
        },
        text);
}
std::string manipulation(const std::string& text) {
    return said(
        [](const std::string& t) {
            const auto m = parse_manipulation(Mode::add, t);
            std::string out = m.group.text + "|" + m.cells.text + m.patterns.text + m.table.text + "|" +
                              std::to_string(m.every) + std::to_string(m.step) +
                              std::to_string(m.times.value_or(0)) + (m.backwards ? "<" : "") + "|" +
                              m.from.text + "|" + m.until.text;
            if (!m.cells.empty())
                for (const auto& [cell, value] : parse_cell_values(m.cells.text))
                    out += " " + cell.cells_text + ":" + std::to_string(value).substr(0, 3);
            return out;
        },
        text);
}
std::string plot(const std::string& text) {
    return said(
        [](const std::string& t) {
            const auto p = parse_plot(t);
            std::string out = std::string(Plot::name(p.kind)) + "|" + p.what + "|";
            for (const auto& [first, last, step] : p.cycles)
                out += std::to_string(first) + "-" + std::to_string(last) + "/" + std::to_string(step) + " ";
            return out + "|" + std::to_string(p.blocks_across) + "x" + std::to_string(p.blocks_down);
        },
        text);
}

}  // namespace

TEST_CASE("Every example of the reference is read") {
    const std::map<std::string, std::function<void(const std::string&)>> parsers = {
        {"source", [](const std::string& t) { parse_source(t); }},
        {"condition", [](const std::string& t) { parse_condition(t); }},
        {"quantity", [](const std::string& t) { parse_quantity(t); }},
        {"formula", [](const std::string& t) { Formula{t}; }},
        {"assignment", [](const std::string& t) { parse_assignment(t); }},
        {"change",
         [](const std::string& t) {
             const auto change = parse_change(t);
             parse_condition(change.when.text);
             if (!parse_world_change(change.change.text)) parse_assignment(change.change.text);
         }},
        {"manipulation",
         [](const std::string& t) {
             const auto m = parse_manipulation(Mode::clamp, t);
             if (!m.cells.empty()) parse_cell_values(m.cells.text);
             for (const auto& when : {m.from, m.until})
                 if (!when.empty()) parse_condition(when.text);
         }},
        {"plot", [](const std::string& t) {
             const auto p = parse_plot(t);
             if (p.of_cells()) parse_source(p.what);
         }}};
    std::ifstream page(test::source_dir() / "docs/reference/expressions.md");
    std::map<std::string, int> read;
    std::string kind;
    for (std::string line; std::getline(page, line);) {
        if (line.starts_with("```"))
            kind = kind.empty() ? line.substr(3) : "";
        else if (const auto parser = parsers.find(kind); parser != parsers.end()) {
            INFO(line);
            CHECK_NOTHROW(parser->second(line));
            ++read[kind];
        }
    }
    CHECK(read.size() == parsers.size());
    for (const auto& [name, count] : read) CHECK(count >= 3);
}

TEST_CASE("A source is a column, its mean, and some of its cells") {
    CHECK(source("Bug/Light") == "Bug/Light");
    const auto s = parse_source("mean:Bug/Light:vm(2..4, 1)");
    CHECK((s.reduction == "mean" && s.column.text == "Bug/Light:vm" &&
           s.cells == model::Region{2, 1, 3, 1, {}}));
    CHECK(parse_source("Bug/Motor(5,2..9)").cells == model::Region{5, 2, 1, 8, {}});
    CHECK(parse_source(" Bug/Motor ( 5 , 5 ) ").cells == model::Region{5, 5, 1, 1, {}});
    CHECK(source("mean(Bug/Light)") == "mean:Bug/Light");
    CHECK(source(" mean ( Bug/Light:vm(2..4,1) ) ") == "mean:Bug/Light:vm(2..4,1)");
    CHECK(source("max(Bug/Light:vm)") == "max:Bug/Light:vm");
    CHECK(source("max:Bug/Light(1,1)") == "max:Bug/Light(1,1)");
    CHECK(source("\"Bug/Light\"") == "Bug/Light");
    CHECK(source("mean(\"Bug/Light\":vm(1,1))") == "mean:Bug/Light:vm(1,1)");
    CHECK(source("mean:\"Bug/Light:vm\"") == "mean:Bug/Light:vm");
    // Impossible cells belong to no group.
    for (const char* none : {"P/G(3..1,1)", "P/G(0,1)", "P/G(1..2147483647,-2147483648..2147483647)"})
        CHECK((parse_source(none).cells->width == 0 || parse_source(none).cells->height == 0));
}

TEST_CASE("Names may contain blanks, dots, colons, parentheses and quotes") {
    for (const char* name : {"Reactive/US (light)",
                             "Reactive/US (a,b)",
                             "P/G (",
                             "P/G ()",
                             "P/a:b",
                             "P/a.b",
                             "P/a=b",
                             "P/a > b",
                             "P/a and b",
                             "P/5\" disk",
                             "\"P/A",
                             "\"P\"/A",
                             "mean",
                             "mean/G",
                             "means(P/A)",
                             "mean(a)/G (b)",
                             "max",
                             "max(a)/G (b)",
                             "P/US (1,1) x",
                             "P/A(1..,1)",
                             ""}) {
        const auto s = parse_source(name);
        CHECK(s.column.text == name);
        CHECK(!s.cells);
        CHECK(s.reduction.empty());
    }
    CHECK(parse_source("Reactive/US (light)(1,1)").column.text == "Reactive/US (light)");
    CHECK(parse_source("US (a(1,1)").column.text == "US (a");
    CHECK(condition("Reactive/US (light) > 1 and (Reactive/US (light)(1,1) < 1)") ==
          "((Reactive/US (light) > 1.00) and (Reactive/US (light)(1,1) < 1.00))");
    CHECK(condition("\"P/a > b\"(1,1) < max(\"P/(\")") == "(P/a > b(1,1) < max(P/())");
    CHECK(condition("\"cycle\" > cycle") == "(cycle > cycle)");
    CHECK(parse_condition("\"cycle\" > cycle").quantities[0].kind == Quantity::cell);
    CHECK(assignment("P/A.1.threshold=a=b") == "P/A.1|threshold|a=b");
    CHECK(assignment("\"P/A=1.x\".threshold = 2") == "P/A=1.x|threshold|2");
    CHECK(manipulation("P/US (light)(1,1)=1") == "P/US (light)|(1,1)=1|110|| (1,1):1.0");
    CHECK(plot("space:P/a@b:vm@1") == "space|P/a@b:vm|1-1/1 |1x1");
    CHECK(plot("time:\"P/a@b;c\"") == "time|\"P/a@b;c\"||1x1");
}

TEST_CASE("'and' binds before 'or', and parentheses before both") {
    CHECK(condition("trial 8 || cycle 100 && trial 7") ==
          "((trial >= 8.00) or ((cycle >= 100.) and (trial >= 7.00)))");
    CHECK(condition("(trial 8 or cycle 100)and 4 s") ==
          "(((trial >= 8.00) or (cycle >= 100.)) and (seconds >= 4.00))");
    CHECK(condition("mean:P/A(1..2,1)>sum( P/A:vm )") == "(mean(P/A(1..2,1)) > sum(P/A:vm))");
    CHECK(condition("30 s&&1<2") == "((seconds >= 30.0) and (1.00 < 2.00))");
}

TEST_CASE("Mistakes are reported with their column") {
    CHECK(condition("") == "1: something is missing at its end");
    CHECK(condition("cycle = 5") == "7: '=' is not a comparison");
    CHECK(condition("cycle => 5") == "7: '=>' is not a comparison");
    CHECK(condition("cycle =< 5") == "7: '=<' is not a comparison");
    CHECK(condition("trial 1 or cycle -1") == "12: 'cycle -1' is before the run");
    CHECK(condition("-2 s") == "1: '-2 s' is before the run");
    CHECK(condition("cycle 5 and trial") == "18: a comparison is missing behind 'trial'");
    CHECK(condition("1 < cycle < 5") == "11: '< 5' is left over");
    CHECK(condition("(cycle 5") == "9: a ')' is missing");
    CHECK(condition("mean(P/A > 5") == "10: a ')' is missing");
    CHECK(condition("1 < \"P/A") == "5: a '\"' is missing");
    CHECK(condition("cycle > cycle 5") == "9: there is nothing to compare in it");
    CHECK(condition("&&") == "1: '&' is not expected here");
    CHECK(condition(std::string(200, '(')) == "101: more than 100 '(' are open");
    CHECK(condition(std::string(70'000, '(')) == "1: it is longer than 65536 characters");
    for (const char* nonsense : {"", "=", "threshold=1", ".threshold=1", "P/A.threshold", "P/A"})
        CHECK(assignment(nonsense) == "1: not an assignment");
    CHECK(manipulation("P/A(1,1)=1; every 0") == "13: 'every' needs a whole number, at least 1");
    CHECK(manipulation("P/A(1,1)=1; from cycle 3;; ") == "26: '' is not an option of a manipulation");
    CHECK(manipulation("P/A(1,1)=1 (2,x)=1") == "9: '(2,x)' is not a cell");
    CHECK(manipulation("P/A(1,1)=1 2") == "9: '2' is not a cell with a value");
    CHECK(manipulation("P/A(1,1)=on") == "7: 'on' is not a number");
    CHECK(manipulation("t.csv; every 2") == "6: a table says itself in which cycles its rows hold");
    CHECK(manipulation("") == "1: no manipulation");
    CHECK(plot("pie:P/A") == "1: there is no plot 'pie'");
    CHECK(plot("space:P/A@1,5..2") == "13: '5..2' is not a cycle");
    CHECK(plot("space:P/A;blocks=0x1") == "11: 'blocks=0x1' is not an option of a plot");
    CHECK(plot("trajectory@5..2") == "12: '5..2' is not a trial");
    CHECK(plot("connection:") == "1: which connection?");
}

TEST_CASE("Manipulations have cells, patterns or a table, and options") {
    CHECK(
        manipulation("P/A(1,1)=0.5 (2,2)=1; every 2; step 3; times 4; backwards; from cycle 5; until 3 s") ==
        "P/A|(1,1)=0.5 (2,2)=1|234<|cycle 5|3 s (1,1):0.5 (2,2):1.0");
    CHECK(manipulation("P/A=p.txt") == "P/A|p.txt|110||");
    CHECK(manipulation("t.csv; until \"P/A;B\" > 1") == "|t.csv|110||\"P/A;B\" > 1");
}

TEST_CASE("Plots have a kind, a subject, cycles and blocks") {
    CHECK(plot("space:P/A(1..2,1)@0..100/10,7;blocks=3x2") == "space|P/A(1..2,1)|0-100/10 7-7/1 |3x2");
    CHECK(plot("diagram") == "diagram|||1x1");
    CHECK(plot("trajectory@2..4") == "trajectory||2-4/1 |1x1");
    CHECK(plot("connection:A @ B") == "connection|A @ B||1x1");
    CHECK(plot("curve:trial length") == "curve|trial length||1x1");
    CHECK(plot("learning") == "learning|||1x1");
    CHECK(plot("wiring:A@3") == "wiring|A|3-3/1 |1x1");
    CHECK(plot("connection:A @ B@0,10..20/5") == "connection|A @ B|0-0/1 10-20/5 |1x1");
}

TEST_CASE("A mistake in a file is reported at its place, and one on the command line with its column") {
    const auto file = std::make_shared<SourceFile>(SourceFile{"e.xml", "<e>\n  <at when=\"1 &lt; 2 x\"/>\n"});
    Diagnostics diagnostics;
    Context{"1 < 2 x", "at", diagnostics, {file, 2, 13}}.parsed(&parse_condition);
    Context{"1 < 2 x", "--at", diagnostics}.parsed(&parse_condition);
    REQUIRE(diagnostics.errors() == 2);
    CHECK(diagnostics.all()[0].where.line == 2);
    CHECK(diagnostics.all()[0].where.column == 22);
    CHECK(diagnostics.all()[0].message == "at '1 < 2 x': 'x' is left over");
    CHECK(diagnostics.all()[1].message == "--at '1 < 2 x', column 7: 'x' is left over");
}
