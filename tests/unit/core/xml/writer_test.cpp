#include "core/xml/writer.h"

#include <filesystem>

#include "core/model/build.h"
#include "core/model/validate.h"
#include "tests/support/catch.h"
#include "tests/support/folder.h"
#include "tests/support/golden.h"
#include "tests/support/model_text.h"
#include "tests/support/paths.h"

using namespace forage;
using test::Folder;
using test::replaced;
using test::small_system;
using test::system_of;

namespace {

/// The first process of the small system, as a file of its own, with a connection.
std::string process_text() {
    return xml::write_process(model::extract_process(system_of(small_system), "p"));
}

std::string linking_system(const std::string& path) {
    return "<System id=\"s\" name=\"S\" author=\"\" date=\"\" cylesPerSecond=\"25\">\n"
           "  <Process id=\"p\" name=\"placeholder\" path=\"" +
           path +
           "\"><DiagramIcon x=\"7\" y=\"8\"/><!-- forage:phantom group='far' x='1' y='2' "
           "--></Process>\n</System>\n";
}

}  // namespace

TEST_CASE("Every element and attribute survives writing and reading") {
    const model::System s = system_of(small_system);
    const std::string text = xml::write_system(s);
    CHECK(system_of(text) == s);
    CHECK(xml::write_system(system_of(text)) == text);
    CHECK(text.find("<!DOCTYPE System PUBLIC '-//INI/iqr421' 'iqrSystem.dtd'>") != std::string::npos);
    for (const char* kept : {"About &lt;this&gt;", "hostname=\"host\"", "#00FF00", "enableModule=\"false\"",
                             "Line 1\nLine 2", "height=\"7\"", "APTarget=\"15\""})
        CHECK(text.find(kept) != std::string::npos);
}

TEST_CASE("Two systems that differ anywhere are not equal") {
    const model::System s = system_of(small_system);
    const auto differs = [&](const std::string& what, const std::string& by) {
        return !(system_of(replaced(small_system, what, by)) == s);
    };
    CHECK(differs("x=\"-10\"", "x=\"-11\""));
    CHECK(differs("Line 2", "Line 3"));
    CHECK(differs("value=\"-0.25\"", "value=\"-0.250\""));  // parameters stay as they were written
    CHECK(differs("APTarget=\"15\"", "APTarget=\"14\""));
    CHECK(differs("#FFFFFF", "#FFFFFE"));
    CHECK_FALSE(differs("<Note>n</Note>", "<Note>n</Note>\n\n"));  // locations do not matter
}

TEST_CASE("Comments stay with the process, group or connection before or in which they stand") {
    std::string text = replaced(small_system, "<System", "<!-- of the file -->\n<System");
    text = replaced(text, "<Group id=\"b\"", "<!-- of b --><Group id=\"b\"");
    text = replaced(text, "<Topology><TopologySparse>", "<Topology><!-- in b --><TopologySparse>");
    text = replaced(text, "<Connection", "<!-- of c -->\n  <!-- and more --><Connection");
    text = replaced(text, "</System>", "<!-- last --></System>");
    const model::System s = system_of(text);
    CHECK(s.comments == std::vector<std::string>{" of the file ", " last "});
    CHECK(s.processes[0].groups[0].comments.empty());
    CHECK(s.processes[0].groups[1].comments == std::vector<std::string>{" of b ", " in b "});
    CHECK(s.connections[0].comments == std::vector<std::string>{" of c ", " and more "});
    CHECK(system_of(xml::write_system(s)) == s);
}

TEST_CASE("Comments on a page, places of phantoms and vertices of both pages are XML comments") {
    model::System s = system_of(small_system);
    const auto q = model::add_process(s, "Q");
    const auto g = model::add_group(s, q, "G", 3, 2, "neuronLinearThreshold", "g");
    const auto c = model::add_connection(s, g, "a", InputKind::excitatory, "synapseFixedWeight");
    model::add_canvas_comment(
        s, {}, {"one", "Ends --> here -- \"not\" 'yet' & <b>\nsecond line", "", {-1, 2, 3, 4}, {}});
    model::add_canvas_comment(s, "p", {"two", "größer", "#ffeeaa", {10, 20, 30, 40}, {}});
    s.processes[0].phantoms = {{g, 5, -60}};
    model::find_connection(s, c)->line->vertices = {{1, 2, {}}};
    model::find_connection(s, c)->line->source_vertices = {{3, 4, {}}, {-5, 6, {}}};
    model::find_connection(s, c)->line->target_vertices = {{7, 8, {}}};
    const std::string text = xml::write_system(s);
    INFO(text);
    CHECK(system_of(text) == s);
    for (const char* kept : {"<!-- forage:comment id=\"two\" x=\"10\" y=\"20\" width=\"30\" height=\"40\" "
                             "color=\"#ffeeaa\" text=\"größer\" -->",
                             "<!-- forage:phantom group=\"g\" x=\"5\" y=\"-60\" -->",
                             "<!-- forage:vertices page=\"source\" points=\"3,4 -5,6\" -->",
                             "<!-- forage:vertices page=\"target\" points=\"7,8\" -->"})
        CHECK(text.find(kept) != std::string::npos);
    CHECK(s.comments.empty());
    // The original and older versions see comments in a valid file, so nothing else of it changes.
    model::System bare = s;
    bare.canvas_comments.clear();
    for (auto& p : bare.processes) p.canvas_comments.clear(), p.phantoms.clear();
    auto& line = *model::find_connection(bare, c)->line;
    line.source_vertices.clear(), line.target_vertices.clear();
    std::string without = text;
    for (std::size_t from; (from = without.find("<!-- forage:")) != std::string::npos;) {
        const auto begin = without.rfind('\n', from);
        without.erase(begin, without.find("-->", from) + 3 - begin);
    }
    CHECK(system_of(without) == bare);
}

TEST_CASE("A part of the diagram with a mistake, or in a wrong place, stays a comment and gives a warning") {
    for (const std::string wrong :
         {"forage:comment id='x' x='1' y='2' width='3'",
          "forage:comment id='x' x='1' y='2' width='3' height='0'",
          "forage:comment id='x' x='1.5' y='2' width='3' height='4'",
          "forage:comment id='x' x='1' y='2' width='3' height='4' font='5'", "forage:comment id='x x='1'",
          "forage:note text='x'", "forage:phantom group='a' x='1' y='2'", "forage:"}) {
        Diagnostics diagnostics;
        const std::string text = replaced(small_system, "</System>", "<!-- " + wrong + " --></System>");
        const auto s = xml::parse_system("small.iqr", text, diagnostics);
        INFO(wrong);
        REQUIRE(s);
        CHECK(diagnostics.warnings() == 1);
        CHECK(diagnostics.all()[0].message == "this is no part of the diagram that Forage can read");
        CHECK(diagnostics.all()[0].where.line > 1);
        CHECK(s->canvas_comments.empty());
        CHECK(s->comments == std::vector<std::string>{" " + wrong + " "});
        CHECK(xml::write_system(*s).find("<!-- " + wrong + " -->") != std::string::npos);
    }
}

TEST_CASE(
    "Line ends and tabs in attributes and notes survive, a processing instruction before the root too") {
    std::string text = replaced(small_system, "name=\"Small\"", "name=\"a&#13;b&#10;c&#9;d\"");
    text = replaced(text, "About &lt;this&gt;", "one&#13;two");
    text = replaced(text, "<!DOCTYPE", "<?xml-model href=\"iqr.rng\"?>\n<!DOCTYPE");
    const auto s = system_of(text);
    CHECK(s.name == "a\rb\nc\td");
    const std::string written = xml::write_system(s);
    CHECK(written.find("a&#13;b&#10;c&#9;d") != std::string::npos);
    CHECK(written.find("<?xml-model href=\"iqr.rng\"?>") != std::string::npos);
    CHECK(system_of(written) == s);
}

TEST_CASE("A process is extracted and imported without references to groups outside it") {
    model::System s = system_of(small_system);
    const auto q = model::add_process(s, "Q");
    const auto g = model::add_group(s, q, "G", 3, 2, "neuronLinearThreshold", "g");
    model::add_connection(s, g, "a", InputKind::excitatory, "synapseFixedWeight");
    s.processes[0].module->outputs[0].target = g;
    auto file = model::extract_process(s, "p");
    CHECK(file.process.module->outputs[0].target.empty());
    CHECK(file.connections.size() == 1);
    file.connections[0].source = "elsewhere";
    CHECK_THROWS_AS(model::import_process(s, file), std::invalid_argument);
}

TEST_CASE("A note that a comment or CDATA section divides is read as a whole") {
    const auto s =
        system_of(replaced(small_system, "Line 1\nLine 2", "one <!-- x -->two <![CDATA[<three>]]>"));
    CHECK(s.processes[0].groups[1].note == "one two <three>");
    CHECK(system_of(xml::write_system(s)) == s);
}

TEST_CASE("A process gives constants to the file that it links") {
    const Folder folder;
    folder.write("brain.iqrProcess", process_text());
    std::string text = linking_system("brain.iqrProcess");
    text.insert(text.find('>', text.find("path=\"brain")) + 1, "<Constant name=\"k\" value=\"1\"/>");
    Diagnostics diagnostics;
    CHECK_FALSE(xml::read_system(folder.write("system.iqr", text), diagnostics));
    REQUIRE(diagnostics.all().size() == 1);
    CHECK(diagnostics.all()[0].message == "'brain.iqrProcess' has no constant 'k'");
    folder.write("brain.iqrProcess",
                 replaced(process_text(), "<Module", "<Constant name=\"k\" value=\"2\"/><Module"));
    const auto s = xml::read_system((folder.path / "system.iqr").string(), diagnostics);
    REQUIRE(s);
    CHECK(s->processes[0].constants[0].value == "1");
}

TEST_CASE("A linked process is read from its file, with its connections, and written as a link") {
    const Folder folder;
    folder.write("brain.iqrProcess", process_text());
    const auto file = folder.write("system.iqr", linking_system("brain.iqrProcess"));
    Diagnostics diagnostics;
    const auto s = xml::read_system(file, diagnostics);
    INFO(format(diagnostics));
    REQUIRE(s);
    CHECK(diagnostics.all().empty());
    REQUIRE(s->processes.size() == 1);
    CHECK(s->processes[0].name == "placeholder");  // as the system says it
    CHECK(s->processes[0].groups.size() == 2);
    CHECK(s->processes[0].icon->x == 7);  // where the system shows it
    CHECK(s->processes[0].phantoms == std::vector<model::Phantom>{{"far", 1, 2}});
    CHECK(s->processes[0].canvas_comments.empty());  // the file of the process has none
    CHECK(s->connections.size() == 1);
    const std::string written = xml::write_system(*s);
    CHECK(written.find("path=\"brain.iqrProcess\"") != std::string::npos);
    CHECK(written.find("name=\"placeholder\"") != std::string::npos);  // as the system says it
    CHECK(written.find("<Group") == std::string::npos);
    CHECK(written.find("<Connection") == std::string::npos);
    folder.write("again.iqr", written);
    const auto again = xml::read_system((folder.path / "again.iqr").string(), diagnostics);
    REQUIRE(again);
    CHECK(*again == *s);

    model::System changed = *s;
    CHECK_THROWS_AS(model::add_group(changed, "p", "G", 1, 1, "neuronNumeric"), std::invalid_argument);
    CHECK_THROWS_AS(model::remove(changed, "a"), std::invalid_argument);
    model::System embedded = *s;
    model::embed_links(embedded);
    CHECK(xml::write_system(embedded).find("<Connection") != std::string::npos);
}

TEST_CASE("A projection that its file states stays stated") {
    model::System s = system_of(small_system);
    auto& c = s.connections[0];
    c.terse = true, c.pattern = model::MappedPattern{};
    CHECK(xml::write_system(s).find("<PatternMapped") == std::string::npos);
    std::get<model::MappedPattern>(c.pattern).is_stated = true;
    const auto again = system_of(xml::write_system(s));
    CHECK(std::get<model::MappedPattern>(again.connections[0].pattern).is_stated);
}

TEST_CASE("Mistakes in a linked process are reported with its file") {
    const Folder folder;
    const auto say = [&](const std::string& file) {
        Diagnostics diagnostics;
        CHECK_FALSE(xml::read_system(file, diagnostics));
        return format(diagnostics);
    };
    const auto file = folder.write("system.iqr", linking_system("absent.iqrProcess"));
    CHECK(say(file).find("system.iqr:2:44: error: process 'placeholder' is linked to 'absent.iqrProcess'") !=
          std::string::npos);
    folder.write("bad.iqrProcess", replaced(process_text(), "hcount", "hcout"));
    CHECK(say(folder.write("system.iqr", linking_system("bad.iqrProcess"))).find("bad.iqrProcess:") !=
          std::string::npos);
    folder.write("self.iqrProcess", replaced(process_text(), "enableModule=\"false\"",
                                             "enableModule=\"false\" path=\"self.iqrProcess\""));
    CHECK(say(folder.write("system.iqr", linking_system("self.iqrProcess"))).find("is linked itself") !=
          std::string::npos);
    CHECK(say(folder.write("system.iqr", linking_system("system.iqr"))).find("would contain itself") !=
          std::string::npos);
}

TEST_CASE("A process file is read, written and read again") {
    const Folder folder;
    const auto path = folder.write("brain.iqrProcess", process_text());
    Diagnostics diagnostics;
    const auto file = xml::read_process(path, diagnostics);
    REQUIRE(file);
    CHECK(file->process.groups.size() == 2);
    CHECK(file->connections.size() == 1);
    CHECK(xml::write_process(*file) == process_text());
}

TEST_CASE("An imported process gets new ids, and its connections and references follow") {
    model::System s = system_of(small_system);
    const auto file = model::extract_process(s, "p");
    CHECK(model::import_process(s, file) == "CB1p");
    CHECK(model::import_process(s, file) == "CB2p");
    REQUIRE(s.processes.size() == 3);
    CHECK(s.processes[1].groups[0].id == "CB1a");
    CHECK(s.processes[1].module->inputs[0].target == "CB1a");
    CHECK(s.connections[1].source == "CB1a");
    CHECK(s.connections[2].target == "CB2b");
    Diagnostics diagnostics;
    Registry registry;
    registry.add(neuron_type<LinearThreshold>());
    registry.add(neuron_type<RandomSpike>());
    registry.add(synapse_type<FixedWeight>());
    model::validate(s, registry, diagnostics);
    for (const auto& d : diagnostics.all())
        CHECK(d.severity == Severity::warning);  // the module type is not there, and disabled
}

TEST_CASE("The original's systems and processes are equal after writing and reading") {
    const auto original = test::shared_dir() / "original";
    if (test::absent(original)) return;
    int files = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(original)) {
        const auto path = entry.path();
        INFO(path);
        Diagnostics diagnostics;
        if (path.extension() == ".iqr") {
            const auto s = xml::read_system(path.string(), diagnostics);
            REQUIRE(s);
            const std::string text = xml::write_system(*s);
            const auto again = xml::parse_system(path.string(), text, diagnostics);
            REQUIRE(again);
            CHECK(*again == *s);
            CHECK(xml::write_system(*again) == text);
            ++files;
        } else if (path.extension() == ".iqrProcess") {
            const auto p = xml::read_process(path.string(), diagnostics);
            REQUIRE(p);
            const Folder folder;
            const auto again =
                xml::read_process(folder.write("p.iqrProcess", xml::write_process(*p)), diagnostics);
            REQUIRE(again);
            CHECK(*again == *p);
            ++files;
        }
    }
    CHECK(files >= 6);
}

TEST_CASE("What a connection leaves out is left out when it is written, unless the original shall read it") {
    model::System system = system_of(
        "<System id=\"s\" name=\"S\"><Process id=\"p\" name=\"P\"><Group id=\"a\" name=\"A\"><Topology>"
        "<TopologyRect hcount=\"1\" vcount=\"1\"/></Topology><Neuron name=\"neuronRandomSpike\"/></Group>"
        "</Process><Connection id=\"c\" name=\"C\" source=\"a\" target=\"a\"><DelayFunction><FunUniform "
        "value=\"3\"/></DelayFunction><Synapse name=\"synapseFixedWeight\"/></Connection></System>");
    const std::string terse = xml::write_system(system);
    CHECK(system_of(terse) == system);
    for (const char* absent : {"<Pattern", "<Arb", "<Attenuation", "<DiagramIcon", "<DiagramLine"})
        CHECK(terse.find(absent) == std::string::npos);
    CHECK(terse.find("<FunUniform value=\"3\"/>") != std::string::npos);

    model::complete(system.processes, system.connections);
    const std::string complete = xml::write_system(system);
    CHECK(system_of(complete) == system);
    for (const char* present :
         {"<PatternMapped type=\"center\">", "<ArbRect width=\"1\" height=\"1\" direction=\"RF\"",
          "<AttenuationFunction>", "<DiagramIcon", "<DiagramLine APSource=\"0\" APTarget=\"0\""})
        CHECK(complete.find(present) != std::string::npos);
}
