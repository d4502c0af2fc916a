// Parameters that change while the system runs.
#include "tests/unit/core/engine/simulations.h"

using namespace forage;
using namespace forage::test;

namespace {

/// Writes `value` in each update; `size` is read at start, and 13 is refused.
struct SizedSay {
    double value = 1;
    int size = 2;
    static void describe(ModuleSpec<SizedSay>& s) {
        s.name("say", "Say").any_ports();
        s.param("value", &SizedSay::value);
        s.param("size", &SizedSay::size).at_start();
    }
    void check(const ModulePorts&, Diagnostics& diagnostics) const {
        if (value == 13) diagnostics.error(at_parameter("value"), "13 is unlucky", "take 14");
    }
    void update(ModuleFrame& frame) { frame.output(0) = value; }
};

/// One (always 1) -> B, linear threshold; and C, which a module writes to.
struct Small {
    model::System system;
    Registry types = registry();
    std::string process, b, c;
    explicit Small(const std::string& synapse = "synapseFixedWeight") {
        types.add(module_type<SizedSay>());
        process = model::add_process(system, "P");
        const auto a = model::add_group(system, process, "A", 2, 1, "one");
        b = model::add_group(system, process, "B", 2, 1, "neuronLinearThreshold");
        c = model::add_group(system, process, "C", 2, 1, "neuronNumeric");
        connect(system, a, b, InputKind::excitatory, synapse, "a-b");
        model::ModuleUse use;
        use.type = "say", use.outputs = {{"out", c, {}}};
        model::find_process(system, process)->module = use;
    }
    model::Assignment read(const std::string& text) const {
        Diagnostics diagnostics;
        const auto a = model::parse_assignment(system, types, text, "--schedule", diagnostics);
        INFO(format(diagnostics));
        REQUIRE(a);
        return *a;
    }
    /// What check() says of changes in this order.
    std::string said(const std::vector<std::string>& texts) const {
        const auto s = run(system, types);
        std::vector<model::Assignment> changes;
        for (const auto& t : texts) changes.push_back(read(t));
        Diagnostics diagnostics;
        s.check(changes, diagnostics);
        return format(diagnostics);
    }
};

}  // namespace

TEST_CASE("A changed gain, weight or module parameter acts in exactly the next phase that reads it") {
    for (const bool general : {false, true}) {
        const Small small;
        auto s = run(small.system, small.types, {.general_forms = general});
        for (int t = 0; t < 3; ++t) s.step();
        CHECK(activity(s, "P/B")[0] == 1);
        s.set(small.read("P/B.excGain=0.5"));
        s.step();
        CHECK(activity(s, "P/B")[1] == 0.5);  // read in this very cycle
        s.set(small.read("a-b.weight=3"));
        s.step();
        CHECK(activity(s, "P/B")[1] == 0.5);  // delivered in this cycle,
        s.step();
        CHECK(activity(s, "P/B")[1] == 1.5);  // received in the next one
        s.set(small.read("P.value=7"));
        s.step();
        CHECK(activity(s, "P/C")[0] == 1);
        s.step();
        CHECK(activity(s, "P/C")[0] == 7);
    }
}

TEST_CASE("A change between phases acts in the following phases") {
    const Small small;
    auto s = run(small.system, small.types);
    s.step();
    s.update_groups();
    s.set(small.read("P/B.excGain=0"));  // too late for the groups
    s.set(small.read("a-b.weight=0.25"));
    CHECK(activity(s, "P/B")[0] == 1);
    s.update_modules();
    s.update_connections();
    s.set(small.read("P/B.excGain=1"));
    s.step();
    CHECK(activity(s, "P/B")[0] == 0.25);
}

TEST_CASE(
    "A system whose weight is changed before the first cycle runs like one with this weight in its file") {
    Small other;
    model::set_parameter(*model::find_connection(other.system, "a-b")->synapse, "weight", "0.3");
    auto expected = run(other.system, other.types);
    const Small small;
    auto s = run(small.system, small.types);
    s.set(small.read("a-b.weight=0.3"));
    for (int t = 0; t < 4; ++t) {
        s.step(), expected.step();
        CHECK((activity(s, "P/B") == activity(expected, "P/B")).all());
    }
}

TEST_CASE("A change that is impossible in a run is refused with a clear message") {
    Small small;
    CHECK(small.said({"P/B.excGain=0", "a-b.weight=2", "P.value=3"}).empty());
    CHECK(small.said({"P.size=3"}).find("'size' is read at start only") != std::string::npos);
    CHECK(small.said({"P.enableModule=false"}).find("cannot be switched on or off") != std::string::npos);
    CHECK(small.said({"P.value=13"}).find("13 is unlucky") != std::string::npos);
    auto s = run(small.system, small.types);
    CHECK_THROWS_AS(s.set(small.read("P.size=3")), engine::RunError);
    CHECK_THROWS_AS(s.set(small.read("P.enableModule=false")), engine::RunError);
    model::find_process(small.system, small.process)->module_enabled = false;
    CHECK(small.said({"P.value=3"}).find("the module is disabled") != std::string::npos);
}

TEST_CASE("Changes are checked as they will be made, and the check changes nothing") {
    const Small small;
    const std::vector<std::string> grow = {"P/B.vmMax=5", "P/B.vmMin=2"},
                                   crossed = {"P/B.clipVm=true", "P/B.vmMin=2"};
    CHECK(small.said(grow).empty());
    CHECK(small.said(crossed).find("warning") != std::string::npos);  // vmMin = 2 above vmMax = 1
    auto s = run(small.system, small.types);
    Diagnostics diagnostics;
    const std::vector changes = {small.read("P/B.excGain=0")};
    s.check(changes, diagnostics);
    s.step(), s.step();
    CHECK(activity(s, "P/B")[0] == 1);
}
