#include "core/model/edit.h"

#include "tests/support/model_text.h"

using namespace forage;
using test::replaced;
using test::small_system;
using test::system_of;

namespace {

struct Edit {
    model::System system;
    Diagnostics diagnostics;
    explicit Edit(const std::string& assignment, const std::string& text = small_system)
        : system(system_of(text)) {
        model::set(system, test::few_types(), assignment, diagnostics);
    }
    std::string said() const {
        INFO(format(diagnostics));
        REQUIRE(diagnostics.all().size() == 1);
        return diagnostics.all()[0].message + " | " + diagnostics.all()[0].hint;
    }
    const model::Group& a() const { return system.processes[0].groups[0]; }
};

std::string value(const model::TypeUse& use, const std::string& name) {
    std::string found = "(unset)";
    for (const auto& s : use.settings)
        if (s.name == name) found = found == "(unset)" ? s.value : "(twice)";
    return found;
}

}  // namespace

TEST_CASE("A parameter of a group, a connection or a module is set by the path of its owner") {
    CHECK(value(Edit("P/A.threshold=0.25").a().neuron, "threshold") == "0.25");
    CHECK(value(Edit("P/A.vmPrs=1").a().neuron, "vmPrs") == "1");  // not in the file until now
    CHECK(value(Edit("#a.vmPrs=1").a().neuron, "vmPrs") == "1");
    CHECK(value(*Edit("A to B.weight=0.5").system.connections[0].synapse, "weight") == "0.5");
    CHECK(value(*Edit("c.weight=1e-3").system.connections[0].synapse, "weight") == "1e-3");
    CHECK(value(*Edit("P.gain=7").system.processes[0].module, "gain") == "7");
    const Edit enabled("P.enableModule=true");
    CHECK(enabled.system.processes[0].module_enabled);
    CHECK(enabled.diagnostics.all().empty());
}

TEST_CASE("An impossible edit changes nothing, and the error lists what exists") {
    CHECK(
        Edit("P/A.treshold=1").said() ==
        "--set 'P/A.treshold=1', column 5: neuronLinearThreshold has no parameter 'treshold' | did you mean "
        "'threshold'?");
    CHECK(Edit("P/C.threshold=1").said() ==
          "--set 'P/C.threshold=1': there is no 'P/C' | did you mean 'P/A'?");
    CHECK(
        Edit("P/A.threshold=x").said() ==
        "--set 'P/A.threshold=x', column 15: 'x' is not a number | Potential below which the activity is 0.");
    CHECK(Edit("P.enableModule=maybe").said() ==
          "--set 'P.enableModule=maybe', column 16: 'maybe' is not true or false | ");
    CHECK(Edit("P.enableModul=true").said() ==
          "--set 'P.enableModul=true', column 3: moduleTest has no parameter 'enableModul' | did you mean "
          "'enableModule'?");
    for (const std::string nonsense : {"", "=", "threshold=1", ".threshold=1", "P/A.threshold", "P/A"}) {
        INFO(nonsense);
        CHECK(Edit(nonsense).said() == "--set '" + nonsense +
                                           "': not an assignment | write Process/Group.parameter=value, for "
                                           "example 'Reactive Layer/Approach.threshold=0.3'");
    }
    CHECK(value(Edit("P/A.threshold=x").a().neuron, "threshold") == "0.5");
}

TEST_CASE("An owner that is ambiguous or has no parameters is refused") {
    const std::string twins = replaced(small_system, "id=\"b\" name=\"B\"", "id=\"b\" name=\"A\"");
    CHECK(Edit("P/A.probability=1", twins).said() ==
          "--set 'P/A.probability=1': 'P/A' names 2 items | use one of 'P/A#a', 'P/A#b'");
    CHECK(value(Edit("P/A#b.probability=1", twins).system.processes[0].groups[1].neuron, "probability") ==
          "1");
    const std::string empty_process =
        replaced(small_system, "</Process>", "</Process><Process id=\"q\" name=\"Q\"/>");
    CHECK(Edit("Q.gain=1", empty_process).said() == "--set 'Q.gain=1': this process has no module | ");
    const std::string strange = replaced(small_system, "moduleTest", "moduleUnknown");
    CHECK(Edit("P.gain=1", strange).said() == "--set 'P.gain=1': the type 'moduleUnknown' is not known | ");
}

TEST_CASE("A value outside its range is set, with a warning") {
    const Edit edit("P/A.threshold=5");
    CHECK(edit.said() == "--set 'P/A.threshold=5': outside the usual range 0 to 1 | ");
    CHECK_FALSE(edit.diagnostics.failed());
    CHECK(value(edit.a().neuron, "threshold") == "5");
    CHECK(Edit("P.gain=101").said() == "--set 'P.gain=101': outside the usual range 0 to 100 | ");
}

TEST_CASE("Names with dots and values with equals signs are split at the right places") {
    const std::string dotted = replaced(small_system, "name=\"A \"", "name=\"A.1\"");
    CHECK(value(Edit("P/A.1.threshold=0.25", dotted).a().neuron, "threshold") == "0.25");
    CHECK(Edit("P/A.threshold=a=b").said() ==
          "--set 'P/A.threshold=a=b', column 15: 'a=b' is not a number | Potential below which the activity "
          "is 0.");
}

TEST_CASE("A parameter has the value of its file, or the default of its type") {
    model::System s = system_of(small_system);
    const Registry types = test::few_types();
    Diagnostics diagnostics;
    const auto found = [&](const char* name) {
        const auto parameter = model::find_parameter(s, types, name, "parameter", diagnostics);
        REQUIRE(parameter);
        return *parameter;
    };
    const auto threshold = found("P/A.threshold");
    const auto before = model::value_of(s, threshold);
    model::set(s, types, "P/A.threshold=0.75", diagnostics);
    CHECK(std::get<double>(model::value_of(s, threshold)) == 0.75);
    model::unset(s, threshold);
    CHECK(model::value_of(s, threshold) == threshold.parameter->default_value);
    CHECK(value(s.processes[0].groups[0].neuron, "threshold") == "(unset)");
    CHECK(std::holds_alternative<double>(before));
    const auto enabled = found("P.enableModule");
    CHECK_FALSE(std::get<bool>(model::value_of(s, enabled)));
    model::unset(s, enabled);
    CHECK(std::get<bool>(model::value_of(s, enabled)));
    CHECK_FALSE(diagnostics.failed());
}

TEST_CASE("An item is found by the name that it has in an assignment") {
    const model::System s = system_of(small_system);
    Diagnostics diagnostics;
    using Owner = model::Assignment::Owner;
    CHECK(model::find_item(s, "P/A", "system", diagnostics)->owner == Owner::group);
    CHECK(model::find_item(s, "P", "system", diagnostics)->owner == Owner::process);
    CHECK(model::find_item(s, "A to B", "system", diagnostics)->id == s.connections[0].id);
    CHECK_FALSE(diagnostics.failed());
    CHECK_FALSE(model::find_item(s, "P/C", "system", diagnostics));
    CHECK(diagnostics.all()[0].message == "system 'P/C': there is no 'P/C'");
}
