// Groups that nobody reads are left out, and nobody else notices. tests/property has random systems.
#include "tests/unit/engine/simulations.h"

using namespace forage;
using namespace forage::test;

namespace {

/// Neither started nor with anything left out.
engine::Simulation build(const model::System& system, const Registry& types) {
    Diagnostics diagnostics;
    auto simulation = engine::Simulation::build(system, types, {}, diagnostics);
    INFO(format(diagnostics));
    REQUIRE(simulation);
    return std::move(*simulation);
}

/// "A B": the groups of process P that are left out, in alphabetical order of their ids.
std::string pruned(const engine::Simulation& s) {
    std::string out;
    for (int g = 0; g < s.groups(); ++g)
        if (s.pruned(g)) out += (out.empty() ? "" : " ") + s.path(g).substr(2);
    return out;
}

/// Copies its input, and counts which outputs it was told to be read.
struct Asking {
    std::shared_ptr<std::vector<bool>> read = std::make_shared<std::vector<bool>>(3);
    static void describe(ModuleSpec<Asking>& s) {
        s.name("asking", "Asking").input("in", "In");
        s.output("first", "First"), s.output("second", "Second"), s.output("unset", "Unset").optional();
    }
    void start(const ModulePorts&, ModuleFrame& frame) { ask(frame); }
    void update(ModuleFrame& frame) {
        frame.output(0) = frame.input(0);
        ask(frame);
    }
    void ask(const ModuleFrame& frame) {
        for (std::size_t i = 0; i < 3; ++i) (*read)[i] = frame.is_read(i);
    }
};

/// A -> B -> C, A -> D with a delay, A -> E by a connection that learns; F and G stand alone.
struct Chain {
    model::System system;
    Registry types = registry();
    std::string process, a, b, c, d, e, f, g;
    Chain() {
        process = model::add_process(system, "P");
        const auto add = [&](const char* name, const char* type) {
            return model::add_group(system, process, name, 2, 1, type, name);
        };
        a = add("A", "counter"), b = add("B", "neuronNumeric"), c = add("C", "neuronNumeric");
        d = add("D", "neuronNumeric"), e = add("E", "neuronNumeric"), f = add("F", "counter");
        g = add("G", "neuronNumeric");
        connect(system, a, b, InputKind::excitatory, "synapseFixedWeight", "1");
        connect(system, b, c, InputKind::excitatory, "synapseFixedWeight", "2");
        connect(system, a, d, InputKind::excitatory, "synapseFixedWeight", "3").delay = uniform(3);
        auto& learn = connect(system, a, e, InputKind::excitatory, "synapseHebbian", "4");
        learn.synapse->feedback.push_back({"postact", "act", {}});
    }
    void use_module(const std::string& in, const std::string& first, const std::string& second) {
        types.add(module_type(asking));
        model::ModuleUse use;
        use.type = "asking";
        use.inputs = {{"in", in, {}}}, use.outputs = {{"first", first, {}}, {"second", second, {}}};
        model::find_process(system, process)->module = use;
    }
    Asking asking;
    static constexpr int learning = 3;  ///< the connection
};

}  // namespace

TEST_CASE("Without being told to, a simulation leaves nothing out") {
    const Chain chain;
    CHECK(pruned(run(chain.system, chain.types)).empty());
}

TEST_CASE("A group is read when it is observed, or leads to one that is, by way of others too") {
    const Chain chain;
    const auto observing = [&](std::vector<std::string> groups) {
        auto s = build(chain.system, chain.types);
        engine::Demand observed;
        for (const auto& id : groups) observed.groups.push_back(group(s, "P/" + id));
        s.prune(observed);
        return pruned(s);
    };
    CHECK(observing({}) == "");  // a run that computes nothing is of no use
    CHECK(observing({"C"}) == "D E F G");
    CHECK(observing({"B"}) == "C D E F G");
    CHECK(observing({"D", "F"}) == "B C E G");
    CHECK(observing({"E", "G"}) == "B C D F");
}

TEST_CASE("What is left out stays out: there is no second choice") {
    const Chain chain;
    auto s = build(chain.system, chain.types);
    s.prune({{group(s, "P/A")}, {}, {}});
    CHECK_THROWS_AS(s.prune({{group(s, "P/B")}, {}, {}}), std::logic_error);

    auto whole = build(chain.system, chain.types);
    engine::Demand all;
    for (int g = 0; g < whole.groups(); ++g) all.groups.push_back(g);
    whole.prune(all);  // nothing, which is a choice as well
    CHECK_THROWS_AS(whole.prune({{group(whole, "P/A")}, {}, {}}), std::logic_error);
    CHECK(pruned(whole).empty());
}

TEST_CASE("Groups that read each other, and that nobody else reads, are left out together") {
    Chain chain;
    connect(chain.system, chain.c, chain.b, InputKind::inhibitory, "synapseFixedWeight", "5");
    auto s = build(chain.system, chain.types);
    s.prune({.groups = {group(s, "P/D")}});
    CHECK(pruned(s) == "B C E F G");
    auto other = build(chain.system, chain.types);
    other.prune({.groups = {group(other, "P/B")}});
    CHECK(pruned(other) == "D E F G");
}

TEST_CASE("A connection of a kind that the target's type does not read leads nowhere") {
    Chain chain;
    connect(chain.system, chain.g, chain.f, InputKind::excitatory, "synapseFixedWeight", "5");
    auto s = build(chain.system, chain.types);
    CHECK_FALSE(s.type(group(s, "P/F")).reads[0]);
    s.prune({.groups = {group(s, "P/F")}});
    CHECK(pruned(s) == "A B C D E G");
}

TEST_CASE("What a module takes as an input is read; its outputs are, when their groups are") {
    Chain chain;
    chain.use_module(chain.b, chain.f, chain.g);
    auto s = build(chain.system, chain.types);
    s.prune({.groups = {group(s, "P/G")}});
    CHECK(pruned(s) == "C D E F");
    s.start();
    CHECK(*chain.asking.read == std::vector<bool>{false, true, false});
    s.step();
    CHECK(*chain.asking.read == std::vector<bool>{false, true, false});
    CHECK(s.has_written(0, 0));
    CHECK_FALSE(s.has_written(0, 1));
    CHECK_THROWS_WITH(s.module_output(0, 0), Catch::Contains("output 'first' of process 'P' was left out"));
    CHECK(s.module_output(0, 1).size() == 2);
    CHECK(s.module_output(0, 2).size() == 0);  // unset
}

TEST_CASE("An output of a module can be looked at without its group") {
    Chain chain;
    chain.use_module(chain.a, chain.f, chain.g);
    auto s = build(chain.system, chain.types);
    s.prune({.outputs = {{0, 0}}});
    CHECK(pruned(s) == "B C D E F G");
    s.start();
    CHECK(*chain.asking.read == std::vector<bool>{true, false, false});
    for (int t = 0; t < 4; ++t) s.step();
    CHECK(s.module_output(0, 0)[1] == 4);
}

TEST_CASE("A module is told that all its outputs are read, unless they are unset, when nothing is left out") {
    Chain chain;
    chain.use_module(chain.a, chain.f, chain.g);
    auto s = run(chain.system, chain.types);
    CHECK(*chain.asking.read == std::vector<bool>{true, true, false});
    auto other = build(chain.system, chain.types);
    other.prune({.groups = {group(other, "P/F"), group(other, "P/G")}});
    other.start();
    CHECK(*chain.asking.read == std::vector<bool>{true, true, false});
}

TEST_CASE("Demand synapses learn as ever; others to groups that are left out cannot be looked at") {
    const Chain chain;
    auto all = run(chain.system, chain.types);
    auto s = build(chain.system, chain.types);
    s.prune({.connections = {Chain::learning}});
    CHECK(pruned(s) == "B C D F G");
    s.start();
    for (int t = 0; t < 9; ++t) all.step(), s.step();
    REQUIRE(s.synapse_state(Chain::learning, 0).size() == 2);
    CHECK((s.synapse_state(Chain::learning, 0) == all.synapse_state(Chain::learning, 0)).all());
    CHECK((activity(s, "P/E") == activity(all, "P/E")).all());

    auto without = build(chain.system, chain.types);
    without.prune({.groups = {group(without, "P/A")}});
    CHECK_THROWS_AS(without.synapse_state(Chain::learning, 0), std::logic_error);
}

TEST_CASE("Who looks at a group that is left out is told so") {
    const Chain chain;
    auto s = build(chain.system, chain.types);
    s.prune({.groups = {group(s, "P/B")}});
    s.start();
    s.step();
    const int c = group(s, "P/C");
    const auto told = Catch::Contains("group 'P/C' was left out of the run, as nobody was to read it");
    CHECK_THROWS_WITH(s.state(c, 0), told);
    CHECK_THROWS_WITH(s.input(c, InputKind::excitatory), told);
    CHECK_THROWS_WITH(s.output(c), told);
    CHECK_THROWS_WITH(s.writable_state(c, 0), told);
    CHECK_THROWS_AS(s.state(c, 0), std::logic_error);
    CHECK(activity(s, "P/B").size() == 2);
    CHECK_THROWS_AS(s.prune({}), std::logic_error);  // too late
}

TEST_CASE("A checkpoint is of a run that leaves out the same") {
    const Chain chain;
    const auto observing = [&](const char* path) {
        auto s = build(chain.system, chain.types);
        s.prune({.groups = {group(s, path)}});
        s.start();
        return s;
    };
    auto one = observing("P/D"), same = observing("P/D"), other = observing("P/C");
    auto all = run(chain.system, chain.types);
    for (int t = 0; t < 5; ++t) one.step(), all.step();
    Archive written;
    one.checkpoint(written);
    Archive read{std::string_view(written.bytes())};
    same.checkpoint(read);
    for (int t = 0; t < 5; ++t) one.step(), all.step(), same.step();
    CHECK((activity(same, "P/D") == activity(all, "P/D")).all());
    CHECK((activity(one, "P/D") == activity(all, "P/D")).all());
    Archive wrong{std::string_view(written.bytes())};
    CHECK_THROWS_WITH(other.checkpoint(wrong), Catch::Contains("what is left out differs"));
}
