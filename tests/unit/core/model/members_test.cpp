// Changes every member of a model in turn. Comparisons, merges and files must notice each change.
#include "core/model/members.h"

#include <functional>

#include "core/model/build.h"
#include "core/model/changes.h"
#include "core/model/merge.h"
#include "core/xml/writer.h"
#include "tests/support/catch.h"
#include "tests/support/model_text.h"

using namespace forage;
using namespace forage::model;
using test::system_of;

namespace {

// Values that differ. A reference to a group leads to the other group.

void change(bool& value) { value = !value; }
void change(double& value) { value += 0.25; }
void change(std::string& value) {
    value = value == "a" || value == "far" ? "b" : value == "b" ? "a" : value + "x";
}
void change(InputKind& kind) {
    kind = kind == InputKind::excitatory ? InputKind::inhibitory : InputKind::excitatory;
}
void change(Icon& icon) { icon.x += 1; }
void change(Line& line) { line.source_anchor += 1; }
void change(Phantom& phantom) { phantom.y += 1; }
void change(Setting& setting) { setting.value = "1"; }
void change(Port& port) { port.name += "x"; }
void change(Initial& initial) { initial.state = "vm", initial.value = "1"; }
void change(Constant& constant) { constant.name = "k", constant.value = "2", constant.minimum = 0.5; }
void change(TypeDeclaration& type) { type.name = type.name + "x", type.equations = {{"output y = exc", {}}}; }
void change(Formulas<System>& formulas) {
    formulas = {{&System::cycles_per_second, "cylesPerSecond", "{10 + 2.5}", 0, 1e6, true, 12.5, {}}};
}
void change(CrossReference& reference) { reference.target = "b"; }
void change(Topology& topology) { topology = RectTopology{7, 2, false, false}; }
void change(Pattern& pattern) { pattern = MappedPattern{true, All{}, All{}}; }
void change(Arborization& arborization) { arborization.probability /= 2; }
void change(DistanceFunction& function) { function.form = UniformFunction{0.125}; }
template <class T>
void change(std::optional<T>& value) {
    value = value.value_or(T());
    change(*value);
}
template <class T>
void change(std::vector<T>& values) {
    if (values.empty()) values.emplace_back();
    change(values.front());
}

// Calls leaf(value, label, effect) with each member that has no members itself.
template <HasMembers T, class Leaf>
void each_leaf(std::vector<T>& values, const char*, Effect effect, const Leaf& leaf);
template <HasMembers T, class Leaf>
void each_leaf(std::optional<T>& value, const char*, Effect effect, const Leaf& leaf);
template <class T, class Leaf>
void each_leaf(T& value, const char* label, Effect effect, const Leaf& leaf) {
    if constexpr (HasMembers<T>)
        each_member<T>([&](const auto& m) {
            if (m.label)
                each_leaf(value.*m.member, m.label, effect == Effect::none ? effect : m.effect, leaf);
        });
    else
        leaf(value, label, effect);
}
template <HasMembers T, class Leaf>
void each_leaf(std::vector<T>& values, const char*, Effect effect, const Leaf& leaf) {
    for (T& value : values) each_leaf(value, nullptr, effect, leaf);
}
template <HasMembers T, class Leaf>
void each_leaf(std::optional<T>& value, const char*, Effect effect, const Leaf& leaf) {
    each_leaf(value.value(), nullptr, effect, leaf);
}

/// A system in which every member has a value.
System full_system() {
    System s = system_of(test::replaced(test::small_system, "<Neuron name=\"neuronRandomSpike\"/>",
                                        "<Neuron name=\"neuronLinearThreshold\"><Parameter "
                                        "name=\"threshold\" value=\"0.5\"/></Neuron>"));
    const auto q = add_process(s, "Q"), far = add_group(s, q, "Far", 3, 2, "neuronLinearThreshold", "far");
    s.processes.back().module = s.processes.front().module;
    s.processes.back().groups.front().neuron.settings = {{"threshold", "0.25", {}, {}}};
    s.processes.front().phantoms = {{far, 5, -60}};
    s.processes.front().ports = {{"in", "a", {}, {}, {}}};
    s.processes.back().ports = {{"in", far, {}, {}, {}}};
    for (const std::string& page : {std::string(), std::string("p")})
        add_canvas_comment(s, page, {{}, "About", "#ffeeaa", {1, 2, 3, 4}, {}});
    const auto c = add_connection(s, "a", far, InputKind::excitatory, "synapseLearning");
    find_connection(s, c)->synapse->feedback = {{"postact", "act", {}}};
    find_connection(s, c)->synapse->settings = {{"weight", "0.5", {}, {}}};
    return s;
}

/// Calls f(before, after, label, effect) with systems that differ in one member.
void each_change(const std::function<void(const System&, const System&, const std::string&, Effect)>& f) {
    const System before = full_system();
    int members = 1;
    for (int changed = 0; changed < members; ++changed) {
        System after = before;
        members = 0;
        std::string what;
        Effect means{};
        each_leaf(after, nullptr, Effect::rebuild,
                  [&]<class T>(T& value, const std::string& label, Effect effect) {
                      if constexpr (!std::same_as<T, Location>)
                          if (label != "the link" && members++ == changed)
                              change(value), what = label, means = effect;
                  });
        INFO(what);
        if (what == "the initial values" &&
            after.processes[0].module->initial.size() + after.processes[1].module->initial.size() > 0)
            continue;                                       // modules have none
        if (what == "the constants of the type") continue;  // they follow from the constants of the system
        f(before, after, what, means);
    }
    CHECK(members > 80);
}

}  // namespace

TEST_CASE("models that differ in any member are not equal") {
    each_change([](const System& before, const System& after, const std::string&, Effect) {
        CHECK_FALSE(before == after);
    });
}

TEST_CASE("a merge takes every member from either side") {
    each_change([](const System& before, System after, const std::string&, Effect) {
        forget_phantoms(after);  // of a connection that leads elsewhere
        for (const auto& merged : {merge(before, after, before), merge(before, before, after)}) {
            CHECK(merged.conflicts.empty());
            CHECK(merged.system == after);
        }
    });
}

TEST_CASE("a run is rebuilt for a member on which its structure depends") {
    Registry registry = test::few_types();
    each_change([&](const System& before, const System& after, const std::string&, Effect effect) {
        const auto changes = parameter_changes(before, after, registry);
        CHECK(changes.has_value() == (effect != Effect::rebuild));
        if (effect == Effect::none) CHECK(changes->empty());
    });
}

TEST_CASE("every member is written and read") {
    each_change([](const System&, const System& after, const std::string& what, Effect) {
        if (what == "the file" || what == "the omission of defaults") return;  // not values of a file
        CHECK(system_of(xml::write_system(after)) == after);
    });
}
