// Parts: process files with ports, constants and types, used any number of times.
#include <algorithm>

#include <fmt/format.h>

#include "core/model/build.h"
#include "core/model/constants.h"
#include "core/model/edit.h"
#include "core/model/lookup.h"
#include "core/model/parts.h"
#include "core/model/refused.h"
#include "core/xml/patch.h"
#include "core/xml/reader.h"
#include "core/xml/writer.h"
#include "tests/support/catch.h"
#include "tests/support/folder.h"
#include "tests/support/model_text.h"

using namespace forage;
using test::replaced;

namespace {

std::string group(const std::string& id, const std::string& type) {
    return fmt::format(
        "<Group id=\"{0}\" name=\"{0}\"><Topology><TopologyRect hcount=\"{{n}}\" vcount=\"1\"/></Topology>"
        "<Neuron name=\"{1}\"/></Group>",
        id, type);
}

/// A file with a type, two groups, a connection with a formula, and ports.
const std::string half_text = R"(<iqrEntity type="Process">
  <NeuronType name="unit">
    <Equations>output y = exc * gain</Equations>
  </NeuronType>
  <Process id="p" name="Half">
    <Constant name="gain" value="2"/>
    <Constant name="n" value="3"/>
    <Port name="in" group="src"/>
    <Port name="out" group="dst"/>
    )" + group("src", "unit") +
                              group("dst", "unit") +
                              R"(
  </Process>
  <Connection id="c" name="C" source="src" target="dst">
    <Synapse name="synapseFixedWeight"><Parameter name="weight" value="{gain / 4}"/></Synapse>
  </Connection>
</iqrEntity>)";

/// A file whose process uses the first.
const std::string whole_text = R"(<iqrEntity type="Process">
  <Process id="w" name="Whole">
    <Constant name="gain" value="0.8"/>
    <Constant name="n" value="2"/>
    <Port name="in" group="inner.in"/>
    <Port name="sum" group="sum"/>
    )" + group("sum", "neuronLinearThreshold") +
                               R"(
  </Process>
  <Process id="inner" name="Inner" path="half.iqrProcess">
    <Constant name="gain" value="{gain / 2}"/><Constant name="n" value="{n}"/>
  </Process>
  <Connection id="x" name="X" source="inner.out" target="sum">
    <Synapse name="synapseFixedWeight"><Parameter name="weight" value="{gain}"/></Synapse>
  </Connection>
</iqrEntity>)";

const std::string nested = R"(<System id="s" name="Nested">
  <Constant name="gain" value="0.1"/>
  <Process id="a" name="A" path="whole.iqrProcess"/>
  <Process id="b" name="B" path="whole.iqrProcess"><Constant name="gain" value="{4 * gain}"/></Process>
  <Connection id="ab" name="A to B" source="a.sum" target="b.in">
    <Synapse name="synapseFixedWeight"/>
  </Connection>
</System>)";

struct Parts {
    test::Folder folder;
    Diagnostics diagnostics;
    Parts() {
        folder.write("half.iqrProcess", half_text);
        folder.write("whole.iqrProcess", whole_text);
    }
    std::optional<model::System> read(const std::string& text) {
        diagnostics = {};
        return xml::read_system(folder.write("system.iqr", text), diagnostics);
    }
    /// The messages about a text with mistakes, without excerpts.
    std::vector<std::string> mistakes(const std::string& text) {
        read(text);
        std::vector<std::string> out;
        for (const auto& d : diagnostics.all())
            out.push_back(
                fmt::format("{}: {}{}", d.where.line, d.message, d.hint.empty() ? "" : " | " + d.hint));
        return out;
    }
};

std::string weight(const model::System& s, std::string_view id) {
    const auto it = std::ranges::find(s.connections, id, &model::Connection::id);
    REQUIRE(it != s.connections.end());
    return it->synapse->settings.at(0).in_force(ParameterKind::real);
}

}  // namespace

TEST_CASE("a part is used twice, with parts of its own and constants of each use") {
    Parts parts;
    auto s = parts.read(nested);
    INFO(format(parts.diagnostics));
    REQUIRE(s);
    CHECK(model::group_paths(*s) == std::vector<std::string>{"A/sum", "A.Inner/src", "A.Inner/dst", "B/sum",
                                                             "B.Inner/src", "B.Inner/dst"});
    CHECK(weight(*s, "a.x") == "0.8");
    CHECK(weight(*s, "a.inner.c") == "0.1");
    CHECK(weight(*s, "b.x") == "0.4");  // its formula is one of the system's constants
    CHECK(weight(*s, "b.inner.c") == "0.05");
    CHECK(model::shape(model::find_group(*s, "b.inner.src")->topology).cells == 2);
    const auto& ab = *model::find_connection(*s, "ab");
    CHECK(ab.source == "a.sum");
    CHECK(ab.target == "b.inner.src");  // through two ports
    CHECK(s->neuron_types.size() == 1);

    SECTION("a file keeps what its author wrote") {
        const std::string written = xml::write_system(*s);
        CHECK(written.find("source=\"a.sum\" target=\"b.in\"") != std::string::npos);
        CHECK(written.find("NeuronType") == std::string::npos);
        CHECK(parts.read(written) == s);
    }
    SECTION("a constant that is set is written where the part is used") {
        auto changed = *s;
        const Registry types;
        const auto a = model::parse_assignment(changed, types, "A.gain = 0.6", "--set", parts.diagnostics);
        REQUIRE(a);
        model::set(changed, *a);
        CHECK(weight(changed, "a.inner.c") == "0.075");
        const std::string text = nested;
        const auto patch = xml::patch((parts.folder.path / "system.iqr").string(), text, *s, changed, false);
        INFO(patch.text);
        CHECK(patch.text.find("path=\"whole.iqrProcess\">\n    <Constant name=\"gain\" value=\"0.6\"/>") !=
              std::string::npos);
    }
    SECTION("without links the system computes the same") {
        auto embedded = *s;
        model::embed_links(embedded);
        const auto again = parts.read(xml::write_system(embedded));
        INFO(format(parts.diagnostics));
        REQUIRE(again);
        for (const char* id : {"a.x", "a.inner.c", "b.x", "b.inner.c"})
            CHECK(weight(*again, id) == weight(*s, id));
    }
}

TEST_CASE("a module of a part reads the group that each use gives") {
    Parts parts;
    parts.folder.write("reader.iqrProcess", R"(<iqrEntity type="Process">
  <Process id="r" name="Reader">
    <Port name="seen"/>
    <Port name="out" group="out"/>
    <Module name="moduleX">
      <XRefHolder name="InputFromGroup"><XRef name="in" target="seen"/></XRefHolder>
      <XRefHolder name="OutputToGroup"><XRef name="out" target="out"/></XRefHolder>
    </Module>
    )" + replaced(group("out", "neuronLinearThreshold"), "{n}", "2") +
                                                "</Process></iqrEntity>");
    // A part that hands its own open port on.
    parts.folder.write("outer.iqrProcess", R"(<iqrEntity type="Process">
  <Process id="o" name="Outer"><Port name="given"/><Port name="out" group="inner.out"/></Process>
  <Process id="inner" name="Inner" path="reader.iqrProcess"><Port name="seen" group="given"/></Process>
</iqrEntity>)");
    const std::string text = R"(<System id="s" name="S">
  <Process id="h" name="H" path="half.iqrProcess"/>
  <Process id="a" name="A" enableModule="false" path="reader.iqrProcess"><Port name="seen" group="h.out"/></Process>
  <Process id="b" name="B" path="outer.iqrProcess"><Port name="given" group="a.out"/></Process>
</System>)";
    const auto s = parts.read(text);
    INFO(format(parts.diagnostics));
    REQUIRE(s);
    const auto seen = [&](std::string_view id) {
        return std::ranges::find(s->processes, id, &model::Process::id)->module->inputs.at(0).target;
    };
    CHECK(seen("a") == "h.dst");
    CHECK(seen("b.inner") == "a.out");
    CHECK(!s->processes.at(1).module_enabled);  // the use can disable it
    const std::string written = xml::write_system(*s);
    CHECK(written.find("<Port name=\"seen\" group=\"h.out\"/>") != std::string::npos);
    CHECK(parts.read(written) == s);

    auto plain = *s;
    Diagnostics diagnostics;
    model::make_original(plain, diagnostics);
    CHECK(xml::write_system(plain).find(" path=") == std::string::npos);
    CHECK(xml::write_system(plain).find("<XRef name=\"in\" target=\"h.dst\"/>") != std::string::npos);
}

TEST_CASE("mistakes about parts are found together, each once and with the place of the use") {
    Parts parts;
    CHECK(
        parts.mistakes(replaced(replaced(nested, "source=\"a.sum\"", "source=\"a.summ\""), "target=\"b.in\"",
                                "target=\"b.inner.src\"")) ==
        std::vector<std::string>{
            "5: 'b.inner.src' is no port of 'half.iqrProcess' | there are 'a.in', 'a.sum', 'b.in', 'b.sum'"});
    CHECK(parts.mistakes(
              replaced(nested, "Constant name=\"gain\" value=\"{4", "Constant name=\"gian\" value=\"{4")) ==
          std::vector<std::string>{"4: 'whole.iqrProcess' has no constant 'gian' | did you mean 'gain'?"});

    parts.folder.write("half.iqrProcess", replaced(half_text, "{gain / 4}", "{gain / 4"));
    parts.folder.write("whole.iqrProcess", replaced(whole_text, "{gain / 2}", "{gian / 2}"));
    const auto found = parts.mistakes(nested);
    CHECK(found == std::vector<std::string>{
                       "10: gain = '{gian / 2}': there is no constant 'gian' | did you mean 'gain'?"});
    CHECK(format(parts.diagnostics).find("used at " + (parts.folder.path / "system.iqr").string() + ":3") !=
          std::string::npos);

    parts.folder.write("half.iqrProcess", replaced(replaced(half_text, "group=\"src\"", "group=\"scr\""),
                                                   "name=\"out\"", "name=\"src\""));
    CHECK(parts.mistakes(nested) ==
          std::vector<std::string>{
              "8: there is no group 'scr' here | did you mean 'src'?",
              "9: the port 'src' has the id of another group | give the port another name"});
    parts.folder.write("half.iqrProcess", whole_text);
    CHECK(parts.mistakes(nested) == std::vector<std::string>{"9: 'half.iqrProcess' would contain itself"});
}

TEST_CASE("a file without ports is linked once, and a type has one meaning") {
    Parts parts;
    parts.folder.write("plain.iqrProcess",
                       replaced(replaced(half_text, "<Port name=\"in\" group=\"src\"/>", ""),
                                "<Port name=\"out\" group=\"dst\"/>", ""));
    const std::string twice = replaced(replaced(nested, "whole", "plain"), "whole", "plain");
    const auto found = parts.mistakes(twice);
    REQUIRE(found.size() == 1);
    CHECK(found[0].find("the ids 'src', 'dst', 'c' would occur twice") != std::string::npos);

    parts.folder.write("other.iqrProcess", replaced(half_text, "exc * gain", "exc"));
    CHECK(
        parts.mistakes(R"(<System id="s" name="S">
  <Process id="a" name="A" path="half.iqrProcess"/>
  <Process id="b" name="B" path="other.iqrProcess"/></System>)") ==
        std::vector<std::string>{fmt::format("2: the type 'unit' is declared otherwise in '{}' | give one of "
                                             "them another name",
                                             (parts.folder.path / "half.iqrProcess").string())});
}

TEST_CASE("parts that use each other without end are refused") {
    Parts parts;
    const auto part = [](int uses, const std::string& file) {
        std::string out =
            "<iqrEntity type=\"Process\"><Process id=\"p\" name=\"P\"><Port name=\"in\" group=\"a\"/>"
            "<Group id=\"a\" name=\"A\"><Neuron name=\"neuronLinearThreshold\"/></Group></Process>";
        for (int i = 0; i < uses; ++i)
            out += fmt::format("<Process id=\"u{0}\" name=\"U{0}\" path=\"{1}\"/>", i, file);
        return out + "</iqrEntity>";
    };
    const std::string first =
        R"(<System id="s" name="S"><Process id="x" name="X" path="0.iqrProcess"/></System>)";
    const auto write = [&](int files, int uses) {
        for (int i = 0; i < files; ++i)
            parts.folder.write(fmt::format("{}.iqrProcess", i),
                               part(i + 1 < files ? uses : 0, fmt::format("{}.iqrProcess", i + 1)));
    };
    write(6, 20);  // 3,200,000 uses of the last one
    CHECK(parts.mistakes(first) ==
          std::vector<std::string>{
              "1: the process files that this system uses have more than 64 MB, counted at each use"});
    write(64, 1);
    CHECK(parts.mistakes(first).empty());
    write(65, 1);
    CHECK(parts.mistakes(first) == std::vector<std::string>{"1: parts use each other more than 64 deep"});
}

TEST_CASE("an extracted process has its types, and ports for the connections that left it") {
    Parts parts;
    const auto s = parts.read(R"(<System id="s" name="S"><Constant name="n" value="2"/>
  <NeuronType name="unit"><Equations>output y = exc</Equations></NeuronType>
  <Process id="p" name="P">)" +
                              group("a", "unit") + R"(</Process>
  <Process id="q" name="Q">)" +
                              group("b", "neuronLinearThreshold") +
                              R"(</Process>
  <Connection id="c" name="C" source="a" target="b"><Synapse name="synapseFixedWeight"/></Connection></System>)");
    INFO(format(parts.diagnostics));
    REQUIRE(s);
    const auto file = model::extract_process(*s, "p");
    CHECK(file.neuron_types.size() == 1);
    parts.folder.write("p.iqrProcess", xml::write_process(file));
    const auto again = parts.read(R"(<System id="s" name="S"><Process id="x" name="X" path="p.iqrProcess"/>
  <Process id="y" name="Y" path="p.iqrProcess"/>
  <Connection id="c" name="C" source="x.a" target="y.a"><Synapse name="synapseFixedWeight"/></Connection></System>)");
    INFO(format(parts.diagnostics));
    CHECK(again);
}

TEST_CASE("a use that is dissolved keeps its ids and numbers, and others stay uses") {
    Parts parts;
    auto s = parts.read(nested);
    REQUIRE(s);
    const auto before = *s;
    CHECK_THROWS_AS(model::dissolve(*s, "a.inner"), model::Refused);  // in the file of another one
    CHECK_THROWS_AS(model::dissolve(*s, "c"), std::invalid_argument);
    model::dissolve(*s, "a");
    CHECK_THROWS_AS(model::dissolve(*s, "a"), model::Refused);
    const auto patch =
        xml::patch((parts.folder.path / "system.iqr").string(), std::string(nested), before, *s, false);
    INFO(patch.text << format(patch.diagnostics));
    REQUIRE(patch.system);
    CHECK_FALSE(patch.diagnostics.failed());
    CHECK(model::group_paths(*patch.system) == model::group_paths(before));
    for (const char* id : {"a.x", "a.inner.c", "b.x", "b.inner.c"})
        CHECK(weight(*patch.system, id) == weight(before, id));
    CHECK(patch.extent == xml::Extent::least);
    CHECK(patch.text.find("NeuronType name=\"unit\"") != std::string::npos);
    CHECK(patch.text.find("<Process id=\"b\" name=\"B\" path=\"whole.iqrProcess\">") != std::string::npos);
    CHECK(patch.text.find("source=\"a.sum\" target=\"b.in\"") != std::string::npos);
}

TEST_CASE("a process becomes a part, with the ids and numbers that it had") {
    Parts parts;
    const std::string text = R"(<System id="s" name="S"><Constant name="n" value="2"/>
  <NeuronType name="unit"><Equations>output y = exc</Equations></NeuronType>
  <!-- about P -->
  <Process id="p" name="P">)" +
                             group("p.a", "unit") + group("p.b", "unit") + R"(</Process>
  <Process id="q" name="Q">)" +
                             group("z", "neuronLinearThreshold") +
                             R"(</Process>
  <Connection id="p.c" name="C" source="p.a" target="p.b"><Synapse name="synapseFixedWeight"/></Connection>
  <Connection id="out" name="Out" source="p.b" target="z"><Synapse name="synapseFixedWeight"/></Connection></System>)";
    const auto made_of = [&](const std::string& system) {
        auto s = parts.read(system);
        INFO(format(parts.diagnostics));
        REQUIRE(s);
        const auto before = *s;
        auto made = model::make_part(*s, "p", "p.iqrProcess");
        parts.folder.write("p.iqrProcess", xml::write_process(made.file));
        auto patch = xml::patch((parts.folder.path / "system.iqr").string(), system, before, *s, false);
        INFO(patch.text << "\n" << xml::write_process(made.file) << format(patch.diagnostics));
        REQUIRE(patch.system);
        CHECK(patch.extent == xml::Extent::least);
        CHECK_FALSE(patch.diagnostics.failed());
        return std::pair(made.renamed, patch);
    };
    SECTION("its ids begin with that of the process") {
        const auto [renamed, patch] = made_of(text);
        CHECK(renamed.empty());
        CHECK(patch.text.find("<!-- about P -->") != std::string::npos);
        CHECK(patch.text.find("NeuronType") == std::string::npos);  // only the part needs it
        const auto& s = *patch.system;
        CHECK(model::group_paths(s) == std::vector<std::string>{"P/p.a", "P/p.b", "Q/z"});
        const auto& out = s.connections.at(0).id == "out" ? s.connections.at(0) : s.connections.at(1);
        CHECK(out.source == "p.b");
        const auto set = model::with(s, {model::Assignment::Owner::constant, "n", nullptr, {}, "n=5", {}});
        CHECK(model::shape(std::ranges::find(set.processes, "p", &model::Process::id)->groups[0].topology)
                  .cells == 5);
        auto back = s;
        model::dissolve(back, "p");
        CHECK(std::ranges::none_of(back.processes, &model::Process::linked));
        CHECK(model::find_connection(back, "p.c")->name == "P.C");
        CHECK(model::make_part(back, "p", "p.iqrProcess").file.connections.at(0).name == "C");
    }
    SECTION("others get such ids") {
        const auto [renamed, patch] = made_of(
            replaced(replaced(replaced(text, "id=\"p.a\"", "id=\"a\""), "source=\"p.a\"", "source=\"a\""),
                     "id=\"p.c\"", "id=\"c\""));
        CHECK(renamed == std::vector<std::string>{"p.a", "p.c"});
        CHECK(patch.system->processes[0].ports.size() == 1);
    }
    SECTION("without connections to others, all groups are ports") {
        const auto [renamed, patch] =
            made_of(replaced(text, "source=\"p.b\" target=\"z\"", "source=\"z\" target=\"z\""));
        CHECK(patch.system->processes[0].ports.size() == 2);
    }
}
