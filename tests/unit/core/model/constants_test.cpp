#include "core/model/constants.h"

#include "core/base/number.h"
#include "core/model/build.h"
#include "core/model/changes.h"
#include "core/model/edit.h"
#include "core/model/merge.h"
#include "core/model/operations.h"
#include "core/model/validate.h"
#include "core/xml/patch.h"
#include "core/xml/reader.h"
#include "core/xml/writer.h"
#include "tests/support/catch.h"
#include "tests/support/model_text.h"

using namespace forage;
using namespace forage::model;

namespace {

const std::string file_with_constants = R"(<System id="s" name="S" cylesPerSecond="{1000 / ms}">
  <Constant name="ms" value="4"/>
  <Constant name="channels" value="{2 * 3}" minimum="1" maximum="10" unit="cells" doc="How many."/>
  <Constant name="lambda" value="0.25"/>
  <Process id="p" name="P">
    <Constant name="lambda" value="{2 * bias}"/>
    <Constant name="bias" value="0.125"/>
    <Group id="a" name="A"><Topology><TopologyRect hcount="{channels}" vcount="1"/></Topology>
      <Neuron name="neuronLinearThreshold"><Parameter name="threshold" value="{0.25 + lambda}"/></Neuron></Group>
    <Group id="b" name="B"><Topology><TopologyRect hcount="{channels + 1}" vcount="1"/></Topology>
      <Neuron name="neuronLinearThreshold"/></Group>
  </Process>
  <Process id="q" name="Q">
    <Group id="c2" name="C"><Topology><TopologyRect hcount="4" vcount="1"/></Topology><Neuron name="neuronLinearThreshold"/></Group>
  </Process>
  <Connection id="within" name="Within" type="inhibitory" source="a" target="b">
    <Synapse name="synapseFixedWeight"><Parameter name="weight" value="{bias}"/></Synapse>
  </Connection>
  <Connection id="c" name="A to C" type="excitatory" source="a" target="c2">
    <Pattern><PatternForeach><Region xstart="{channels - 1}" ystart="1" width="2" height="1"/><All/></PatternForeach></Pattern>
    <DelayFunction><FunUniform value="{round(0.02 / dt)}"/></DelayFunction>
    <Synapse name="synapseFixedWeight"><Parameter name="weight" value="{-lambda}"/></Synapse>
  </Connection>
</System>
)";

System read(const std::string& content) {
    Diagnostics diagnostics;
    auto s = xml::parse_system("s.iqr", content, diagnostics);
    INFO(format(diagnostics));
    REQUIRE(s);
    REQUIRE_FALSE(diagnostics.failed());
    return *std::move(s);
}

std::string with(const std::string& from, const std::string& to) {
    return test::replaced(file_with_constants, from, to);
}

/// The mistakes of a file, as a user sees them.
std::string mistakes(const std::string& content) {
    Diagnostics diagnostics;
    const auto s = xml::parse_system("s.iqr", content, diagnostics);
    if (s) validate(*s, test::few_types(), diagnostics);
    std::string out;
    for (const auto& d : diagnostics.all())
        out += std::to_string(d.where.line) + ":" + std::to_string(d.where.column) + ": " + d.message +
               (d.hint.empty() ? "" : "; " + d.hint) + "\n";
    return out;
}

double weight(const System& s) {
    return *parse_number<double>(s.connections[1].synapse->settings[0].in_force(ParameterKind::real));
}
int cells(const System& s, int group) { return shape(s.processes[0].groups[group].topology).cells; }

}  // namespace

TEST_CASE("formulas give numbers of every kind their values") {
    const System s = read(file_with_constants);
    CHECK(s.cycles_per_second == 250);
    CHECK(cells(s, 0) == 6);
    CHECK(cells(s, 1) == 7);
    CHECK(s.processes[0].groups[0].neuron.settings[0].computed == "0.5");  // the lambda of the process
    CHECK(weight(s) == -0.25);                                             // that of the system
    CHECK(std::get<Region>(std::get<ForeachPattern>(s.connections[1].pattern).source).x == 5);
    CHECK(std::get<UniformFunction>(s.connections[1].delay.form).value == 5);
}

TEST_CASE("a constant that changes, changes what depends on it") {
    const System before = read(file_with_constants);
    const auto types = test::few_types();
    const auto set_to = [&](const std::string& assignment) {
        Diagnostics diagnostics;
        System s = before;
        set(s, types, assignment, diagnostics);
        INFO(format(diagnostics));
        CHECK_FALSE(diagnostics.failed());
        return s;
    };
    const System more = set_to("lambda=0.5");
    CHECK(weight(more) == -0.5);
    CHECK(more.processes[0].groups[0].neuron.settings[0].computed == "0.5");
    const auto changes = parameter_changes(before, more, types);
    REQUIRE(changes);
    REQUIRE(changes->size() == 1);
    CHECK(changes->front().text == "A to C.weight=-0.5");

    CHECK(set_to("P.bias=0.25").processes[0].groups[0].neuron.settings[0].computed == "0.75");
    CHECK(weight(set_to("lambda={ms / 8}")) == -0.5);
    CHECK(set_to("ms=8").cycles_per_second == 125);

    const System wider = set_to("channels=9");
    CHECK(cells(wider, 0) == 9);
    CHECK(cells(wider, 1) == 10);
    CHECK_FALSE(parameter_changes(before, wider, types));  // the run is rebuilt

    for (const auto& name : parameter_names(before, types)) {
        Diagnostics diagnostics;
        CHECK(find_parameter(before, types, name, "set", diagnostics));
    }
}

TEST_CASE("a change of a constant is checked before it is made") {
    const auto refused = [](const std::string& assignment) {
        Diagnostics diagnostics;
        System s = read(file_with_constants);
        const System before = s;
        set(s, test::few_types(), assignment, diagnostics);
        CHECK(s == before);
        REQUIRE(diagnostics.failed());
        const auto& d = diagnostics.all().front();
        return d.message + (d.hint.empty() ? "" : "; " + d.hint);
    };
    CHECK(refused("channels=11") == "--set 'channels=11': channels = 11, more than its maximum 10");
    CHECK(refused("channels=2.5") == "hcount = '{channels}' is 2.5, which is not a whole number");
    CHECK(
        refused("lambda=high") ==
        "--set 'lambda=high': lambda = 'high': 'high' is not a number; a formula stands in braces: {2 * x}");
    CHECK(refused("lambda={lambda}") ==
          "--set 'lambda={lambda}': constants depend on each other in a circle: lambda, "
          "lambda");
    CHECK(refused("lamda=0.5") == "--set 'lamda=0.5': there is no constant 'lamda'; did you mean 'lambda'?");
}

TEST_CASE("a file keeps its formulas when it is written, and when it is edited") {
    const System s = read(file_with_constants);
    CHECK(read(xml::write_system(s)) == s);
    System edited = s;
    std::get<RectTopology>(edited.processes[0].groups[1].topology).width = 3;
    Diagnostics none;
    CHECK(compute(edited, none));
    CHECK(cells(edited, 1) == 3);  // an edit replaces a formula
    CHECK(xml::patched(file_with_constants, s, edited) == with("{channels + 1}", "3"));
    Diagnostics diagnostics;
    edited = s;
    set(edited, test::few_types(), "channels=8", diagnostics);
    CHECK(xml::patched(file_with_constants, s, edited) == with("{2 * 3}", "8"));
    CHECK(read(xml::patched(file_with_constants, s, edited)) == edited);

    System theirs = s;
    theirs.processes[0].groups[1].name = "Other";
    const auto merged = merge(s, edited, theirs).system;
    CHECK(cells(merged, 1) == 9);

    edited = s;
    set_parameter(edited, "c", "weight", "{lambda^2}");
    const auto patch = xml::patch("s.iqr", file_with_constants, s, edited);
    CHECK(patch.text == with("{-lambda}", "{lambda^2}"));
    CHECK(patch.extent == xml::Extent::least);
}

TEST_CASE("mistakes in constants and formulas are all reported, and only once") {
    CHECK(mistakes(file_with_constants) == "");
    CHECK(mistakes(with("{2 * 3}", "{2 * }")) ==
          "3:41: channels = '{2 * }': something is missing at its end\n");
    CHECK(mistakes(with("value=\"0.125\"", "value=\"0,125\"")) ==
          "7:34: bias = '0,125': '0,125' is not a number; did you mean '0.125'?\n");
    CHECK(mistakes(with("{0.25 + lambda}", "{0.25 + lamda}")) ==
          "9:87: threshold = '{0.25 + lamda}': there is no constant 'lamda'; did you mean 'lambda'?\n");
    CHECK(
        mistakes(with("{channels + 1}", "{channels + chanels}")) ==
        "10:72: hcount = '{channels + chanels}': there is no constant 'chanels'; did you mean 'channels'?\n");
    CHECK(mistakes(with("{2 * bias}", "{1 / (bias - bias)}")) ==
          "6:36: lambda = {1 / (bias - bias)} is inf, which is not a finite number\n");
    CHECK(mistakes(with("value=\"0.125\"", "value=\"{lambda}\"")) ==
          "6:36: constants depend on each other in a circle: lambda, bias, lambda\n");
    CHECK(mistakes(with("name=\"bias\" value", "name=\"2x\" value")) ==
          "6:41: lambda = '{2 * bias}': there is no constant 'bias'; there are 'lambda', '2x', 'ms', "
          "'channels', 'dt'\n"
          "7:21: a constant cannot be called '2x'; letters, digits and _, not first a digit, and no word of "
          "formulas such as 'if' or 'dt'\n"
          "17:73: weight = '{bias}': there is no constant 'bias'; there are 'lambda', '2x', 'ms', "
          "'channels', 'dt'\n");
    CHECK(mistakes(with("{1000 / ms}", "{1 / dt}")) ==
          "1:46: cylesPerSecond = '{1 / dt}': cylesPerSecond cannot depend on dt, which is 1 / "
          "cylesPerSecond\n");
}

TEST_CASE("formulas keep their numbers when systems are joined, and when parts are copied") {
    const System s = read(file_with_constants);
    System same = s;
    join(same, s);
    CHECK(same.constants == s.constants);
    CHECK(same.connections.back().synapse->settings[0].value == "{-lambda}");
    System other = s;
    Diagnostics diagnostics;
    set(other, test::few_types(), "lambda=0.5", diagnostics);
    System joined = other;
    join(joined, s);
    compute(joined);
    CHECK(joined.constants == other.constants);
    CHECK(joined.connections.back().synapse->settings[0].value == "-0.25");
    System empty;
    join(empty, s);
    CHECK(empty.constants == s.constants);

    const auto threshold_of_copy = [&](System into) {
        const auto text = xml::write_system(copy(s, std::vector<std::string>{"a"}));
        const auto id = paste(into, read(text), "p", 0, 0).front();
        compute(into);
        CHECK(shape(find_group(into, id)->topology).cells == 6);
        return find_group(into, id)->neuron.settings[0];
    };
    CHECK(threshold_of_copy(s).value == "{0.25 + lambda}");
    set(other, test::few_types(), "P.bias=0.25", diagnostics);
    CHECK(threshold_of_copy(other).value == "0.5");
    System bare;
    add_process(bare, "P", "p");
    CHECK(threshold_of_copy(bare).value == "0.5");
}

TEST_CASE("the original gets numbers instead of formulas") {
    System s = read(file_with_constants);
    Diagnostics diagnostics;
    make_original(s, diagnostics);
    CHECK(xml::write_system(s).find('{') == std::string::npos);
    CHECK(weight(s) == -0.25);
    auto file = extract_process(read(file_with_constants), "p");
    CHECK(xml::write_process(file).find("name=\"channels\" value=\"{2 * 3}\"") != std::string::npos);
    make_original(file, diagnostics);
    CHECK_FALSE(diagnostics.failed());
    CHECK(xml::write_process(file).find('{') == std::string::npos);
}
