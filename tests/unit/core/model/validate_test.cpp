#include "core/model/validate.h"

#include <cmath>

#include "tests/support/model_text.h"

using namespace forage;
using test::replaced;
using test::small_system;
using test::system_of;

namespace {

/// A system without mistakes: the small one, its module's process enabled or not.
std::string good(bool enabled = false) {
    return enabled ? replaced(small_system, "enableModule=\"false\"", "enableModule=\"true\"") : small_system;
}

Diagnostics validated(const std::string& text, bool lenient = false) {
    Diagnostics diagnostics;
    diagnostics.lenient = lenient;
    model::validate(system_of(text), test::few_types(), diagnostics);
    return diagnostics;
}

/// The one diagnostic of a system with one mistake, as "line:column: severity: message | hint".
std::string mistake(const std::string& text, bool lenient = false) {
    const Diagnostics diagnostics = validated(text, lenient);
    INFO(format(diagnostics));
    REQUIRE(diagnostics.all().size() == 1);
    const auto& d = diagnostics.all().front();
    return std::to_string(d.where.line) + ":" + std::to_string(d.where.column) + ": " +
           (d.severity == Severity::error ? "error: " : "warning: ") + d.message +
           (d.hint.empty() ? "" : " | " + d.hint);
}

const std::string synapse =
    "<Synapse name=\"synapseFixedWeight\"><Parameter name=\"weight\" value=\"-0.25\"/></Synapse>";
const std::string to_a =
    "source=\"a\" target=\"a\"";  // a target that reads inhibition and has the states vm and act

std::string learning(const std::string& holder) {
    const std::string text = replaced(good(), "source=\"a\" target=\"b\"", to_a);
    return replaced(text, synapse, "<Synapse name=\"synapseLearning\">" + holder + "</Synapse>");
}

}  // namespace

TEST_CASE("A system without mistakes gives only one warning, that random spikes read no input") {
    CHECK(mistake(good()) ==
          "28:3: warning: connection 'A to B' has no effect: neuronRandomSpike reads no inhibitory input");
    CHECK(validated(replaced(good(), "source=\"a\" target=\"b\"", to_a)).all().empty());
}

namespace {
/// All mistakes below are made in a system whose connection ends in a type that reads it.
std::string one(const std::string& what, const std::string& by, bool enabled = false, bool lenient = false) {
    return mistake(replaced(replaced(good(enabled), "source=\"a\" target=\"b\"", to_a), what, by), lenient);
}
}  // namespace

TEST_CASE("The rate of a system has limits") {
    for (const double rate : {0., 1e-6, 25., 1e6}) {
        auto system = system_of(good());
        system.cycles_per_second = rate;
        Diagnostics diagnostics;
        model::validate(system, test::few_types(), diagnostics);
        CHECK_FALSE(diagnostics.failed());
    }
    for (const double rate : {5e-324, 1e-310, 1e-300, 9e-7, 2e6, 1e300, -1., HUGE_VAL, std::nan("")}) {
        auto system = system_of(good());
        system.cycles_per_second = rate;
        Diagnostics diagnostics;
        model::validate(system, test::few_types(), diagnostics);
        REQUIRE(diagnostics.errors() == 1);
        CHECK(diagnostics.all().front().message.starts_with("cylesPerSecond = "));
        CHECK(diagnostics.all().front().hint == "cycles in a second, from 1e-6 to 1000000; 0 counts as 25");
    }
}

TEST_CASE("An id that is used twice is reported with its first use") {
    CHECK(one("<Group id=\"b\"", "<Group id=\"p\"") ==
          "21:5: error: the id 'p' of this group is already used on line 5 | ids are unique over the whole "
          "file");
    CHECK(one("<Connection id=\"c\"", "<Connection id=\"a\"") ==
          "28:3: error: the id 'a' of this connection is already used on line 13 | ids are unique over the "
          "whole file");
    CHECK(one("<Group id=\"b\"", "<Group id=\"\"") ==
          "21:5: error: the id of this group is empty | give it one that nothing else in the file has");
}

TEST_CASE("A type that does not exist is reported with the nearest one") {
    CHECK(one("neuronRandomSpike", "neuronRandomSpikes") ==
          "23:21: error: there is no neuron type 'neuronRandomSpikes' | did you mean 'neuronRandomSpike'?");
    CHECK(one("synapseFixedWeight", "synapseFixed") ==
          "33:20: error: there is no synapse type 'synapseFixed' | did you mean 'synapseFixedWeight'?");
    CHECK(one("moduleTest", "moduleTets") ==
          "6:19: warning: there is no module type 'moduleTets'; the module is disabled | did you mean "
          "'moduleTest'?");
    CHECK(one("moduleTest", "moduleTets", true) ==
          "6:19: error: there is no module type 'moduleTets' | did you mean 'moduleTest'?");
}

TEST_CASE("An unknown parameter is reported with the one that was meant, which is also found by its label") {
    CHECK(one("\"threshold\"", "\"treshold\"") ==
          "16:26: error: neuronLinearThreshold has no parameter 'treshold' | did you mean 'threshold' "
          "(Potential below which the activity is 0)?");
    CHECK(one("\"threshold\"", "\"threshold Potential\"") ==
          "16:26: error: neuronLinearThreshold has no parameter 'threshold Potential' | did you mean "
          "'threshold' (Potential below which the activity is 0)?");
    CHECK(one("\"weight\"", "\"colour\"") ==
          "33:57: error: synapseFixedWeight has no parameter 'colour' | there is 'weight'");
    CHECK(one(synapse,
              "<Synapse name=\"synapseLearning\"><Parameter name=\"rate\" value=\"1\"/><XRefHolder "
              "name=\"Freedback\"><XRef name=\"postact\" target=\"act\"/></XRefHolder></Synapse>") ==
          "33:54: error: synapseLearning has no parameter 'rate' | synapseLearning has no parameters");
    CHECK(one("\"threshold\"", "\"treshold\"", false, true).substr(0, 14) == "16:26: warning");
}

TEST_CASE("An invalid value is reported with the expected kind, or with the value that was probably meant") {
    CHECK(one("\"0.5\"/>\n        <P", "\"half\"/>\n        <P") ==
          "16:44: error: threshold = 'half' is not a number | threshold (Potential below which the activity "
          "is 0) is "
          "a number, 0 by default");
    CHECK(one("name=\"clipVm\" value=\"true\"", "name=\"clipVm\" value=\"yes\"") ==
          "17:41: error: clipVm = 'yes' is not true or false | did you mean 'true'?");
    CHECK(one("name=\"gain\" value=\"3\"", "name=\"gain\" value=\"3.5\"") ==
          "7:37: error: gain = '3.5' is not a whole number | gain (Factor of the input) is a whole number, 1 "
          "by default");
}

TEST_CASE("A value outside its range is used, with a warning, for numbers of both kinds") {
    CHECK(one("\"-0.25\"", "\"-2.5\"") ==
          "33:72: warning: weight = -2.5 is outside its usual range | weight (Weight) is meant for -1 to 1; "
          "the value is used as it is");
    CHECK(one("name=\"gain\" value=\"3\"", "name=\"gain\" value=\"101\"") ==
          "7:37: warning: gain = 101 is outside its usual range | gain (Gain) is meant for 0 to 100; the "
          "value is used as it is");
}

TEST_CASE("A parameter that is given twice is an error") {
    CHECK(one("name=\"clipVm\" value=\"true\"", "name=\"threshold\" value=\"1\"") ==
          "17:26: error: parameter 'threshold' is given twice, first on line 16 | remove one of them");
}

TEST_CASE("Groups without cells, and groups that are too large for any memory, are refused") {
    model::System system = system_of(replaced(good(), "source=\"a\" target=\"b\"", to_a));
    std::get<model::RectTopology>(system.processes[0].groups[0].topology).width = 0;
    std::get<model::SparseTopology>(system.processes[0].groups[1].topology).points.clear();
    Diagnostics diagnostics;
    model::validate(system, test::few_types(), diagnostics);
    REQUIRE(diagnostics.errors() == 2);
    CHECK(diagnostics.all()[0].message == "group 'A ' has no cells");
    CHECK(one("hcount=\"3\" vcount=\"2\"", "hcount=\"100000\" vcount=\"101\"") ==
          "13:5: error: group 'A ' is too large: 100000 x 101 | groups have an extent of at most 10000000 "
          "cells");
    CHECK(validated(replaced(replaced(good(), "source=\"a\" target=\"b\"", to_a), "hcount=\"3\" vcount=\"2\"",
                             "hcount=\"100000\" vcount=\"100\""))
              .all()
              .empty());
    CHECK(one("<Point x=\"5\" y=\"4\"/>", "<Point x=\"1000000\" y=\"1000000\"/>") ==
          "21:5: error: group 'B' is too large: 999999 x 999998 | the points of a group have an extent of at "
          "most 10000000 cells");
}

TEST_CASE("An impossible point of a sparse group is an error, or is left out when reading leniently") {
    CHECK(one("<Point x=\"5\" y=\"4\"/>", "<Point x=\"5\" y=\"0\"/>") ==
          "22:53: error: there is no cell at x = 5, y = 0 | cells count from 1");
    CHECK(one("<Point x=\"5\" y=\"4\"/>", "<Point x=\"5\" y=\"0\"/>", false, true).substr(0, 14) ==
          "22:53: warning");
}

TEST_CASE("Unknown groups at the ends of a connection are reported with the id that was meant") {
    CHECK(
        one("source=\"a\"", "source=\"aa\"") ==
        "28:44: error: the source 'aa' of connection 'A to B' is not the id of a group | did you mean 'a'?");
    CHECK(one("target=\"a\" type", "target=\"P/B\" type") ==
          "28:55: error: the target 'P/B' of connection 'A to B' is not the id of a group | 'P/B' is a name; "
          "write 'b'");
    CHECK(one("source=\"a\"", "source=\"A\"") ==
          "28:44: error: the source 'A' of connection 'A to B' is not the id of a group | 'A' is a name; "
          "write 'a'");
    CHECK(one("source=\"a\"", "source=\"nothing\"") ==
          "28:44: error: the source 'nothing' of connection 'A to B' is not the id of a group | ids are the "
          "id attributes of <Group> elements");
}

TEST_CASE("A module's cross references must be set, known, once, and lead to groups") {
    const std::string in = "<XRef name=\"_in\" target=\"a\"/>";
    CHECK(one(in, "<XRef name=\"_in\" target=\"\"/>", true) ==
          "8:41: error: the cross reference '_in' of moduleTest is not set | in InputFromGroup, give it the "
          "id of a group for: Where it reads");
    CHECK(one(in, "", true) ==
          "6:19: error: the cross reference '_in' of moduleTest is not set | in InputFromGroup, give it the "
          "id of a group for: Where it reads");
    CHECK(validated(replaced(replaced(good(), in, ""), "source=\"a\" target=\"b\"", to_a))
              .all()
              .empty());  // the module is disabled
    CHECK(one(in, "<XRef name=\"_inn\" target=\"a\"/>", true) ==
          "8:41: error: moduleTest has no cross reference '_inn' in InputFromGroup | did you mean '_in'?");
    CHECK(one(in, "<XRef name=\"_in\" target=\"z\"/>", true) ==
          "8:41: error: cross reference '_in' leads to 'z', which is not the id of a group | ids are "
          "the id attributes of <Group> elements");
    CHECK(one(in, in + in, true) ==
          "8:70: error: cross reference '_in' is given twice, first on line 8 | remove one of them");
}

TEST_CASE("A group of a size that a module cannot use is reported with the size that it needs") {
    CHECK(one("<XRef name=\"_out\" target=\"\"/>", "<XRef name=\"_out\" target=\"b\"/>", true) ==
          "9:40: error: '_out' needs 3 x 2 cells; 'P/B' is 2 cells in 4 x 2 | make the group 3 x 2");
    const auto right =
        validated(replaced(replaced(good(true), "source=\"a\" target=\"b\"", to_a),
                           "<XRef name=\"_out\" target=\"\"/>", "<XRef name=\"_out\" target=\"a\"/>"));
    REQUIRE(right.all().size() == 1);
    CHECK(right.all().front().message ==
          "connection 'A to B' leads to 'P/A', to which the module of process 'P' writes: its cells get the "
          "sum of both");
}

TEST_CASE("Mistakes that a module finds are reported at its parameter or its cross reference") {
    CHECK(one("name=\"gain\" value=\"3\"", "name=\"gain\" value=\"13\"", true) ==
          "7:37: error: unlucky gain in P | choose another");
    CHECK(one("name=\"gain\" value=\"3\"", "name=\"gain\" value=\"14\"", true) ==
          "8:41: error: input is P/A");
}

TEST_CASE("A feedback input must be known and lead to a state of the target") {
    CHECK(mistake(learning("")) ==
          "33:20: error: the feedback input 'postact' of synapseLearning is not set | name a state of the "
          "target's neuronLinearThreshold in <XRefHolder name=\"Freedback\">: vm, act");
    const auto holder = [](const std::string& name, const std::string& state) {
        return "<XRefHolder name=\"Freedback\"><XRef name=\"" + name + "\" target=\"" + state +
               "\"/></XRefHolder>";
    };
    CHECK(validated(learning(holder("postact", "act"))).all().empty());
    CHECK(validated(learning(holder("postact", "vm"))).all().empty());
    CHECK(mistake(learning(holder("postact", "akt"))) ==
          "33:66: error: neuronLinearThreshold has no state 'akt' | did you mean 'act'?");
    CHECK(mistake(replaced(replaced(good(), "source=\"a\" target=\"b\"", to_a), synapse,
                           "<Synapse name=\"synapseFixedWeight\">" + holder("x", "act") + "</Synapse>")) ==
          "33:69: error: synapseFixedWeight has no feedback input 'x' | synapseFixedWeight has none");
}

TEST_CASE("Functions of the distance with an unexpected meaning give a warning") {
    const std::string attenuation = "<FunGaussian min=\"0.1\" max=\"0.9\" sigma=\"1.5\"/>",
                      delay = "<FunBlock min=\"1\" max=\"4\" width=\"3\" height=\"7\"/>";
    CHECK(one(attenuation, "<FunUniform value=\"-1\"/>") ==
          "31:26: warning: a negative attenuation, -1, counts as 0");
    CHECK(one("sigma=\"1.5\"", "sigma=\"0\"") ==
          "31:26: warning: sigma = 0 counts as 0.0001: only distance 0 differs from the rest | sigma is the "
          "width in cells");
    CHECK(one("sigma=\"1.5\"", "sigma=\"-2\"") ==
          "31:26: warning: sigma = -2 counts as 2 | sigma is the width in cells");
    CHECK(one(delay, "<FunUniform value=\"-1\"/>") ==
          "32:20: warning: a delay cannot be negative: -1 | delays below 0 count as 0");
    CHECK(one(delay, "<FunLinear min=\"0\" max=\"2.5\"/>") ==
          "32:20: warning: delays are whole cycles: 2.5 counts as 2");
    CHECK(one(delay, "<FunRandom max=\"100001\"/>") ==
          "32:20: error: a delay of 100001 cycles is not possible | delays are at most 100000 cycles");
    CHECK(validated(replaced(replaced(good(), "source=\"a\" target=\"b\"", to_a), delay,
                             "<FunUniform value=\"100000\"/>"))
              .all()
              .empty());
}

TEST_CASE("Settings are applied to an object, and other parameters keep their defaults") {
    const NeuronType type = neuron_type<LinearThreshold>();
    const auto object = type.make();
    const auto system = system_of(good());
    model::apply(system.processes[0].groups[0].neuron, type.parameters, object->parameters());
    const auto& cell = *static_cast<const LinearThreshold*>(object->parameters());
    CHECK(cell.threshold == 0.5);
    CHECK(cell.membrane.clip);
    CHECK(cell.membrane.exc_gain == Membrane{}.exc_gain);
    model::TypeUse use;
    use.settings = {{"threshold", "x", {}, {}}, {"nothing", "1", {}, {}}};
    model::apply(use, type.parameters, object->parameters());  // reported by validate()
    CHECK(cell.threshold == 0.5);
}
