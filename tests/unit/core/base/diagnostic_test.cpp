#include "core/base/diagnostic.h"

#include "tests/support/catch.h"

using namespace forage;

namespace {

Location place(const std::string& text, int line, int column, const std::string& path = "a.iqr") {
    return {std::make_shared<const SourceFile>(SourceFile{path, text}), line, column};
}

std::string escaped(const std::string& text, int line, int column) {
    return format(Diagnostic{Severity::error, place(text, line, column), "m", "", {}, {}});
}

}  // namespace

TEST_CASE("A diagnostic shows its place, its line with a caret, and its hint") {
    const Diagnostic d{Severity::warning, place("one\n  <two three='3'/>\n", 2, 8), "what", "how", {}, {}};
    CHECK(format(d) == "a.iqr:2:8: warning: what\n      <two three='3'/>\n           ^\n  hint: how\n");
}

TEST_CASE("A diagnostic omits what it does not know") {
    CHECK(format(Diagnostic{Severity::error, {}, "what", "", {}, {}}) == "error: what\n");
    CHECK(format(Diagnostic{Severity::error, place("x", 0, 0), "what", "", {}, {}}) ==
          "a.iqr: error: what\n");
    CHECK(escaped("x\ny", 2, 0) == "a.iqr:2: error: m\n      y\n");  // a line without a column has no caret
    CHECK(escaped("x", 7, 3) == "a.iqr:7:3: error: m\n");            // a line that the file does not have
}

TEST_CASE(
    "The caret stands under its character after tabs, characters of several bytes and Windows line ends") {
    CHECK(escaped("\t\t<x/>\r\n", 1, 3) == "a.iqr:1:3: error: m\n      <x/>\n      ^\n");
    CHECK(escaped("<x y='1'\tz='2'/>\r\n", 1, 10) ==
          "a.iqr:1:10: error: m\n      <x y='1' z='2'/>\n               ^\n");
    CHECK(escaped("\xc3\xa9\xe2\x82\xac x", 1, 7) ==
          "a.iqr:1:7: error: m\n      \xc3\xa9\xe2\x82\xac x\n         ^\n");
}

TEST_CASE("A long line is cut around the place, and never within a character") {
    std::string text(300, '.');
    text[199] = 'X';
    const std::string said = escaped(text, 1, 200);
    const auto line = said.find("\n      "), caret = said.find('^');
    REQUIRE((line != std::string::npos && caret != std::string::npos));
    const auto second = said.find('\n', line + 1);
    CHECK(second - line <= 120);
    CHECK(said[line + 1 + (caret - second - 1)] == 'X');
    std::string wide;
    for (int i = 0; i < 200; ++i) wide += "\xe2\x82\xac";
    for (const int column : {1, 31, 301, 598}) CHECK(escaped(wide, 1, column).find('?') == std::string::npos);
}

TEST_CASE("A file cannot send commands to the terminal that shows its mistakes") {
    const Diagnostic d{
        Severity::error, place("a\x1b[31mb\x07", 1, 1), "id '\x1b[2J\n'", "\x1b]0;x\x07", {}, {}};
    const std::string said = format(d);
    CHECK(said.find('\x1b') == std::string::npos);
    CHECK(said.find('\x07') == std::string::npos);
    CHECK(said.find("id '\\x1b[2J '") != std::string::npos);
    CHECK(said.find("hint: \\x1b]0;x\\x07") != std::string::npos);
    CHECK(escaped("\xff\xfe", 1, 1).find("??") != std::string::npos);
    CHECK(escaped("a\x1b\xc2\x9b"
                  "b",
                  1, 5) == "a.iqr:1:5: error: m\n      a  b\n         ^\n");
}

TEST_CASE("A message is cut to a readable length") {
    const Diagnostic d{Severity::error, {}, std::string(1'000'000, 'x'), "", {}, {}};
    CHECK(format(d).size() < 500);
}

TEST_CASE("Diagnostics are shown in the order of the file, whatever the order in which they were found") {
    const auto file = std::make_shared<const SourceFile>(SourceFile{"a.iqr", "1\n2\n3\n"});
    Diagnostics diagnostics;
    diagnostics.error({file, 3, 1}, "third");
    diagnostics.warning({file, 1, 2}, "second");
    diagnostics.error({file, 1, 1}, "first");
    const std::string said = format(diagnostics);
    CHECK(said.find("first") < said.find("second"));
    CHECK(said.find("second") < said.find("third"));
    CHECK((diagnostics.errors() == 2 && diagnostics.warnings() == 1 && diagnostics.failed()));
}

TEST_CASE("When there are very many diagnostics, the first ones and the number of the others are shown") {
    Diagnostics diagnostics;
    for (int i = 0; i < 1000; ++i) diagnostics.error({}, "m");
    const std::string said = format(diagnostics);
    CHECK(said.ends_with("... and 950 more\n"));
}

TEST_CASE("Something unknown is an error, or a warning when reading leniently") {
    Diagnostics strict, lenient;
    lenient.lenient = true;
    strict.unknown({}, "m");
    lenient.unknown({}, "m");
    CHECK(strict.failed());
    CHECK((!lenient.failed() && lenient.warnings() == 1));
}

TEST_CASE("The nearest name is the one with the fewest changed letters, whatever their case") {
    const std::vector<std::string> names{"excGain", "inhGain", "vmPrs", "threshold"};
    CHECK(nearest("excGian", names) == "excGain");
    CHECK(nearest("EXCGAIN", names) == "excGain");
    CHECK(nearest("treshold", names) == "threshold");
    CHECK(nearest("vm", names) == "");
    CHECK(nearest("colour", names) == "");
    CHECK(nearest("", names) == "");
    CHECK(nearest("x", {}) == "");
    CHECK(nearest("thresh", names) == "threshold");  // a beginning is near, however much is missing
    CHECK(nearest("th", names) == "");
}

TEST_CASE("A suggestion is the nearest name, or else the list of existing names") {
    const std::vector<std::string> one{"vm"}, two{"vm", "act"};
    CHECK(suggest("vn", one) == "did you mean 'vm'?");
    CHECK(suggest("potential", one) == "there is 'vm'");
    CHECK(suggest("potential", two) == "there are 'vm', 'act'");
    CHECK(suggest("x", {}) == "");
    std::vector<std::string> many;
    for (int i = 0; i < 20; ++i) many.push_back("name" + std::to_string(i));
    CHECK(suggest("potential", many).ends_with("'name11' and 8 more"));
}
