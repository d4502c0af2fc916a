#include "core/xml/reader.h"

#include <algorithm>

#include "core/model/build.h"
#include "core/model/lookup.h"
#include "core/xml/rules.h"
#include "core/xml/writer.h"
#include "tests/support/model_text.h"

using namespace forage;
using test::replaced;
using test::small_system;
using test::system_of;

namespace {

/// The one diagnostic of a text with one mistake, as "line:column: message | hint".
std::string mistake(const std::string& text, bool lenient = false) {
    Diagnostics diagnostics;
    diagnostics.lenient = lenient;
    const auto system = xml::parse_system("test.iqr", text, diagnostics);
    INFO(format(diagnostics));
    REQUIRE(diagnostics.all().size() == 1);
    CHECK((system.has_value() || diagnostics.failed()));
    const auto& d = diagnostics.all().front();
    return std::to_string(d.where.line) + ":" + std::to_string(d.where.column) + ": " + d.message + " | " +
           d.hint;
}

}  // namespace

TEST_CASE("A system is read with everything that is in the file") {
    const model::System s = system_of(small_system);
    CHECK((s.id == "s" && s.name == "Small" && s.author == "me" && s.date == "today" && s.port == "54923"));
    CHECK(s.cycles_per_second == 12.5);
    CHECK(s.sync_plots);
    CHECK(s.note == "About <this>");
    CHECK((s.at.line == 3 && s.at.column == 1));

    REQUIRE(s.processes.size() == 1);
    const auto& p = s.processes[0];
    CHECK((p.id == "p" && p.name == "P" && p.hostname == "host" && p.port == "1" && p.color == "#00FF00" &&
           p.path.empty()));
    CHECK_FALSE(p.module_enabled);
    CHECK(p.note == "");
    REQUIRE(p.icon);
    CHECK((p.icon->x == -10 && p.icon->y == 20 && p.icon->width == 50 && p.icon->height == 60));
    REQUIRE(p.module);
    CHECK(p.module->type == "moduleTest");
    REQUIRE(p.module->settings.size() == 1);
    CHECK((p.module->settings[0].name == "gain" && p.module->settings[0].value == "3"));
    CHECK((p.module->settings[0].value_at.line == 7 && p.module->settings[0].value_at.column == 37));
    REQUIRE((p.module->inputs.size() == 1 && p.module->outputs.size() == 1));
    CHECK((p.module->inputs[0].name == "_in" && p.module->inputs[0].target == "a"));
    CHECK((p.module->outputs[0].name == "_out" && p.module->outputs[0].target.empty()));

    REQUIRE(p.groups.size() == 2);
    const auto& a = p.groups[0];
    CHECK(a.name == "A ");  // blanks are kept: writing must not lose them
    const auto& rect = std::get<model::RectTopology>(a.topology);
    CHECK((rect.width == 3 && rect.height == 2 && rect.wrap_x && !rect.wrap_y));
    CHECK(a.neuron.settings.size() == 2);
    CHECK((a.icon->x == 1 && a.icon->width == 50));
    CHECK_FALSE(a.note);
    const auto& points = std::get<model::SparseTopology>(p.groups[1].topology).points;
    REQUIRE(points.size() == 2);
    CHECK((points[1].x == 5 && points[1].y == 4));
    CHECK(p.groups[1].note == "Line 1\nLine 2");

    REQUIRE(s.connections.size() == 1);
    const auto& c = s.connections[0];
    CHECK((c.id == "c" && c.name == "A to B" && c.source == "a" && c.target == "b"));
    CHECK(c.kind == InputKind::inhibitory);
    const auto& pattern = std::get<model::ForeachPattern>(c.pattern);
    const auto& region = std::get<model::Region>(pattern.source);
    CHECK((region.x == 1 && region.y == 2 && region.width == 3 && region.height == 1));
    CHECK(std::get<model::List>(pattern.target).points.size() == 1);
    const auto& window = std::get<model::EllipseWindowArbor>(c.arborization.shape);
    CHECK((window.inner_width == 1 && window.inner_height == 2 && window.outer_width == 3 &&
           window.outer_height == 4));
    CHECK(c.arborization.direction == model::Direction::projective);
    CHECK(c.arborization.probability == 0.5);
    const auto& gaussian = std::get<model::GaussianFunction>(c.attenuation.form);
    CHECK((gaussian.min == 0.1 && gaussian.max == 0.9 && gaussian.sigma == 1.5));
    const auto& block = std::get<model::BlockFunction>(c.delay.form);
    CHECK((block.min == 1 && block.max == 4 && block.width == 3 && block.height == 7));
    REQUIRE(c.synapse);
    CHECK(c.synapse->settings.at(0).value == "-0.25");
    CHECK(c.note == "n");
    REQUIRE(c.line);
    CHECK((c.line->source_anchor == 3 && c.line->target_anchor == 15 && c.line->vertices.size() == 1));
}

TEST_CASE("Each form of pattern, arborization and function is read as itself") {
    const auto with = [](const std::string& what, const std::string& by) {
        return system_of(replaced(small_system, what, by)).connections[0];
    };
    const std::string foreach =
        "<PatternForeach><Region xstart=\"1\" ystart=\"2\" width=\"3\" height=\"1\"/><List><Point x=\"2\" "
        "y=\"3\"/></List></PatternForeach>";
    CHECK(std::get<model::MappedPattern>(
              with(foreach, "<PatternMapped type=\"all\"><All/><All/></PatternMapped>").pattern)
              .all);
    CHECK_FALSE(std::get<model::MappedPattern>(
                    with(foreach, "<PatternMapped type=\"center\"><All/><All/></PatternMapped>").pattern)
                    .all);
    const auto tuples = std::get<model::TuplesPattern>(
        with(foreach,
             "<PatternTuples><Tuple><SourceList><Point x=\"1\" y=\"2\"/></SourceList><TargetList><Point "
             "x=\"3\" y=\"4\"/><Point x=\"5\" y=\"6\"/></TargetList></Tuple></PatternTuples>")
            .pattern);
    REQUIRE(tuples.tuples.size() == 1);
    CHECK((tuples.tuples[0].sources[0].y == 2 && tuples.tuples[0].targets[1].x == 5));

    const std::string window =
        "<ArbEllipseWindow innerwidth=\"1\" innerheight=\"2\" outerwidth=\"3\" outerheight=\"4\" "
        "direction=\"PF\" initialization_probability=\"0.5\"/>";
    const std::string rest = " direction=\"RF\" initialization_probability=\"1\"/>";
    const auto rect = std::get<model::RectArbor>(
        with(window, "<ArbRect width=\"3\" height=\"4\"" + rest).arborization.shape);
    CHECK((rect.width == 3 && rect.height == 4));
    const auto ellipse = std::get<model::EllipseArbor>(
        with(window, "<ArbEllipse width=\"3\" height=\"4\"" + rest).arborization.shape);
    CHECK((ellipse.width == 3 && ellipse.height == 4));
    const auto hole = std::get<model::RectWindowArbor>(
        with(window,
             "<ArbRectWindow innerwidth=\"0\" innerheight=\"1\" outerwidth=\"3\" outerheight=\"4\"" + rest)
            .arborization.shape);
    CHECK(
        (hole.inner_width == 0 && hole.inner_height == 1 && hole.outer_width == 3 && hole.outer_height == 4));
    CHECK(std::holds_alternative<model::AllArbor>(with(window, "<ArbAll" + rest).arborization.shape));
    CHECK(std::get<model::RandomArbor>(with(window, "<ArbRandom count=\"4\"" + rest).arborization.shape)
              .count == 4);

    const std::string gaussian = "<FunGaussian min=\"0.1\" max=\"0.9\" sigma=\"1.5\"/>";
    CHECK(std::get<model::UniformFunction>(with(gaussian, "<FunUniform value=\"0.25\"/>").attenuation.form)
              .value == 0.25);
    const auto linear = std::get<model::LinearFunction>(
        with(gaussian, "<FunLinear min=\"0.25\" max=\"0.75\"/>").attenuation.form);
    CHECK((linear.min == 0.25 && linear.max == 0.75));
    CHECK(std::get<model::RandomFunction>(with(gaussian, "<FunRandom max=\"0.75\"/>").attenuation.form).max ==
          0.75);
}

TEST_CASE("Optional content that is missing has its default") {
    const auto s = system_of(
        "<System id=\"s\" name=\"S\" author=\"\" date=\"\" cylesPerSecond=\"0\"><Process id=\"p\" "
        "name=\"P\"/></System>");
    CHECK(s.cycles_per_second == 0);
    CHECK_FALSE(s.sync_plots);
    CHECK(s.processes[0].module_enabled);
    CHECK_FALSE(s.processes[0].module);
    CHECK_FALSE(s.processes[0].icon);
}

TEST_CASE("The order of attributes does not matter") {
    const std::string turned =
        replaced(small_system, "hcount=\"3\" vcount=\"2\" cylinderHor=\"false\" cylinderVert=\"true\"",
                 "cylinderVert=\"true\" vcount=\"2\" cylinderHor=\"false\" hcount=\"3\"");
    const auto rect = std::get<model::RectTopology>(system_of(turned).processes[0].groups[0].topology);
    CHECK((rect.width == 3 && rect.height == 2 && rect.wrap_x && !rect.wrap_y));
}

TEST_CASE("Every problem of a file is reported, in the order of the file") {
    std::string text = replaced(small_system, "hcount=\"3\"", "hcount=\"x\"");
    text = replaced(text, "type=\"inhibitory\"", "type=\"inhibitor\"");
    text = replaced(text, "cylesPerSecond=\"12.5\"", "cylesPerSecond=\"-1\"");
    Diagnostics diagnostics;
    CHECK_FALSE(xml::parse_system("test.iqr", text, diagnostics));
    REQUIRE(diagnostics.errors() == 3);
    CHECK(diagnostics.all()[0].where.line == 3);
    CHECK(diagnostics.all()[1].where.line == 14);
    CHECK(diagnostics.all()[2].where.line == 28);
}

TEST_CASE("A misspelt attribute is not also reported as missing") {
    CHECK(mistake(replaced(small_system, "vcount", "vcont")) ==
          "14:42: <TopologyRect> has no attribute 'vcont' | did you mean 'vcount'?");
}

TEST_CASE("An unknown element among alternatives is an error even when reading leniently") {
    CHECK(mistake(replaced(small_system, "<FunGaussian min=\"0.1\" max=\"0.9\" sigma=\"1.5\"/>",
                           "<FunGauss min=\"0.1\" max=\"0.9\" sigma=\"1.5\"/>"),
                  true) ==
          "31:26: <AttenuationFunction> cannot hold <FunGauss> | did you mean 'FunGaussian'?");
}

TEST_CASE("Unknown attributes and elements are warnings when reading leniently, and the rest is read") {
    CHECK(mistake(replaced(small_system, "hostname=\"host\"", "hostname=\"host\" mood=\"good\""), true) ==
          "5:44: <Process> has no attribute 'mood' | there are 'id', 'name', 'hostname', 'port', "
          "'enableModule', 'path', 'color'");
    CHECK(mistake(replaced(small_system, "<Note/>", "<Remark/>"), true) ==
          "11:5: <Process> cannot hold <Remark> | there are 'Constant', 'Port', 'Module', 'Note', "
          "'DiagramIcon', "
          "'Group'");
}

TEST_CASE("A remark outside a note is not read") {
    CHECK(mistake(replaced(small_system, "<Topology>", "<Topology>\r\n  three cells")) ==
          "15:3: <Topology> holds no text | write a text in a <Note>, and a remark in <!-- -->");
}

TEST_CASE("Each piece of text in a wrong place is reported, also in the outermost element") {
    Diagnostics diagnostics;
    const std::string text = replaced(replaced(small_system, "<Topology>", "<Topology>one<!-- -->two"),
                                      "</System>", "three</System>");
    xml::parse_system("test.iqr", text, diagnostics);
    CHECK(diagnostics.errors() == 3);
}

TEST_CASE("Cross references of a module are not accepted for a synapse, or the other way round") {
    CHECK(
        mistake(replaced(small_system, "OutputToGroup", "Freedback")) ==
        "9:25: a <Module> has no cross references 'Freedback' | there are 'InputFromGroup', 'OutputToGroup'");
    CHECK(mistake(replaced(small_system, "<Parameter name=\"weight\" value=\"-0.25\"/>",
                           "<XRefHolder name=\"InputFromGroup\"/>")) ==
          "33:58: a <Synapse> has no cross references 'InputFromGroup' | there is 'Freedback'");
}

TEST_CASE("Whole numbers that do not fit into an int are refused and never cast") {
    for (const std::string n : {"2147483648", "99999999999999999999", "1e300", "-1e300"}) {
        INFO(n);
        CHECK(mistake(replaced(small_system, "hcount=\"3\"", "hcount=\"" + n + "\"")) ==
              "14:39: hcount = " + n + " is not possible | hcount: cells in a row, from 1 to 100000");
    }
}

TEST_CASE("Every element that another one can hold is described by the format table") {
    for (const auto* format : {&xml::system_format(), &xml::process_format(), &xml::experiment_format()})
        for (const auto& rule : format->elements) {
            INFO(rule.name);
            CHECK_FALSE(rule.doc.empty());
            for (const auto& child : rule.children) CHECK(format->find(child.name));
            for (const auto& a : rule.attributes) CHECK_FALSE(a.value.doc.empty());
        }
    CHECK(xml::system_format().find("Nothing") == nullptr);
}

TEST_CASE("An attribute that is absent has the default of the format table") {
    const std::string pattern =
        "<PatternForeach><Region xstart=\"1\" ystart=\"2\" width=\"3\" height=\"1\"/><List><Point x=\"2\" "
        "y=\"3\"/></List></PatternForeach>";
    const std::string window =
        "<ArbEllipseWindow innerwidth=\"1\" innerheight=\"2\" outerwidth=\"3\" outerheight=\"4\" "
        "direction=\"PF\" initialization_probability=\"0.5\"/>";
    const std::string shortest =
        "<System id=\"s\" name=\"S\"><Process id=\"p\" name=\"P\"><Group id=\"a\" name=\"A\">"
        "<Neuron name=\"neuronRandomSpike\"/></Group></Process>"
        "<Connection id=\"c\" name=\"C\" source=\"a\" target=\"a\"/></System>";
    std::vector<std::string> texts{shortest, small_system,
                                   replaced(small_system, pattern, "<PatternMapped type=\"all\"/>"),
                                   replaced(small_system, "<Pattern>" + pattern + "</Pattern>",
                                            "<Weights form=\"list\">0 0 1</Weights>")};
    for (const char* shape :
         {"ArbRect width=\"3\" height=\"4\"", "ArbEllipse width=\"3\" height=\"4\"",
          "ArbRectWindow innerwidth=\"1\" innerheight=\"2\" outerwidth=\"3\" outerheight=\"4\"", "ArbAll",
          "ArbRandom count=\"2\""})
        texts.push_back(
            replaced(small_system, window,
                     std::string("<") + shape + " direction=\"PF\" initialization_probability=\"0.5\"/>"));
    /// The text in which the attribute of the first such element has this value, or is absent.
    const auto with = [](std::string text, std::size_t element, const std::string& attribute,
                         const std::string& value) {
        std::size_t at = text.find(' ', element), end = text.find('>', element);
        const std::size_t there = text.find(" " + attribute + "=\"", element);
        if (there < end) text.erase(there, text.find('"', there + attribute.size() + 3) + 1 - there);
        at = std::min(at, text.find_first_of("/>", element));
        return value.empty() ? text : text.insert(at, " " + attribute + "=\"" + value + "\"");
    };
    int tried = 0;
    for (const auto& rule : xml::system_format().elements)
        for (const auto& attribute : rule.attributes) {
            if (attribute.value.otherwise.empty()) continue;
            if (attribute.name == "weight") continue;  // a setting that is left out is not one of 1
            INFO("<" << rule.name << " " << attribute.name << ">");
            const auto text = std::find_if(texts.begin(), texts.end(), [&](const std::string& t) {
                return t.find("<" + rule.name + " ") != std::string::npos;
            });
            REQUIRE(text != texts.end());
            const std::size_t at = text->find("<" + rule.name + " ");
            CHECK(system_of(with(*text, at, attribute.name, "")) ==
                  system_of(with(*text, at, attribute.name, attribute.value.otherwise)));
            ++tried;
        }
    CHECK(tried > 20);
}

TEST_CASE("Sizes and weights may be attributes, and what is left out has its default") {
    const auto system = [](const std::string& group, const std::string& connection) {
        return "<System id=\"s\" name=\"S\">\n<Process id=\"p\" name=\"P\">\n<Group id=\"a\" name=\"A\"" +
               group +
               "<Neuron name=\"neuronRandomSpike\"/></Group></Process>\n"
               "<Connection id=\"c\" name=\"C\" source=\"a\" target=\"a\"" +
               connection + "</System>";
    };
    const std::string text = system(" hcount=\"{1 + 2}\" vcount=\"2\">", " weight=\"{1 / 4}\"/>");
    auto s = system_of(text);
    CHECK(model::shape(s.processes[0].groups[0].topology).cells == 6);
    CHECK(s.connections[0].synapse->type == "synapseFixedWeight");
    CHECK(s.connections[0].synapse->settings.at(0).computed == "0.25");
    const std::string written = xml::write_system(s);
    CHECK(written.find("hcount=\"{1 + 2}\" vcount=\"2\">") != std::string::npos);
    CHECK(written.find("weight=\"{1 / 4}\"/>") != std::string::npos);
    CHECK(system_of(written) == s);
    model::complete(s.processes, s.connections);
    const std::string full = xml::write_system(s);
    for (const char* element :
         {"<TopologyRect", "<Parameter name=\"weight\" value=\"{1 / 4}\"/>", "<ArbRect"})
        CHECK(full.find(element) != std::string::npos);

    const auto least = system_of(system(">", "/>"));
    CHECK(model::shape(least.processes[0].groups[0].topology).cells == 1);
    CHECK(least.connections[0].synapse == model::fixed_weight());
    CHECK(mistake(system(" hcount=\"3\"><Topology><TopologyRect hcount=\"3\" vcount=\"1\"/></Topology>",
                         "/>")) == "3:32: a group has either <Topology> or hcount | remove one of them");
    CHECK(mistake(system(">", " weight=\"2\"><Synapse name=\"synapseFixedWeight\"/></Connection>")) ==
          "4:59: a connection has either <Synapse> or weight | remove one of them");
    CHECK(mistake(system(">", " weight=\"2\"><Weights>1</Weights></Connection>")) ==
          "4:59: a connection has either <Weights> or weight | remove one of them");
}

TEST_CASE("A connection may leave out its pattern, arborization and functions") {
    const auto connection = [](const std::string& parts) {
        return "<System id=\"s\" name=\"S\"><Process id=\"p\" name=\"P\"/><Connection id=\"c\" name=\"C\" "
               "source=\"a\" target=\"b\">" +
               parts + "<Synapse name=\"synapseFixedWeight\"/></Connection></System>";
    };
    auto terse = system_of(connection("")).connections[0];
    const auto written =
        system_of(connection("<Pattern><PatternMapped type=\"center\"><All/><All/></PatternMapped></"
                             "Pattern><Arborization><ArbRect width=\"1\" height=\"1\" "
                             "direction=\"RF\" initialization_probability=\"1\"/></Arborization>"
                             "<AttenuationFunction><FunUniform value=\"0\"/></AttenuationFunction>"
                             "<DelayFunction><FunUniform value=\"0\"/></DelayFunction>"))
            .connections[0];
    CHECK((terse.terse && !written.terse));
    CHECK((terse.attenuation.at.line == 1 && terse.attenuation.at.file));  // warnings have a place
    terse.terse = false;
    CHECK(terse == written);
    CHECK(system_of(connection("<Pattern><PatternForeach/></Pattern>")).connections[0].pattern ==
          model::Pattern(model::ForeachPattern{}));
    CHECK(mistake(connection("<Pattern><PatternForeach><All/></PatternForeach></Pattern>")) ==
          "1:110: <PatternForeach> holds only one element, it needs 2 elements | source, then target, each "
          "one of "
          "<All>, <Region>, <List>");
}
