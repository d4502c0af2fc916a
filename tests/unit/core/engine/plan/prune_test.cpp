// Groups on which nothing that is demanded depends are pruned, which changes nothing else. tests/property has
// random systems.
#include "tests/unit/core/engine/simulations.h"

using namespace forage;
using namespace forage::test;

namespace {

using Demanded = std::vector<std::string>;  ///< groups of process P

engine::Layout layout_of(const model::System& system, const Registry& types) {
    Diagnostics diagnostics;
    auto layout = engine::make_layout(system, types, diagnostics);
    INFO(format(diagnostics));
    REQUIRE(layout);
    return std::move(*layout);
}

/// A demand for activities.
engine::Demand reading(const engine::Layout& layout, const Demanded& groups) {
    engine::Demand out;
    for (const auto& name : groups) out.read_group(group(layout, "P/" + name));
    return out;
}

/// Not started.
engine::Simulation build(const model::System& system, const Registry& types, const engine::Demand& demand) {
    Diagnostics diagnostics;
    auto simulation = engine::Simulation::build(system, types, demand, {}, diagnostics);
    INFO(format(diagnostics));
    REQUIRE(simulation);
    return std::move(*simulation);
}
engine::Simulation build(const model::System& system, const Registry& types, const Demanded& groups) {
    return build(system, types, reading(layout_of(system, types), groups));
}

/// "A B": the groups of process P that are pruned, in alphabetical order of their ids.
std::string pruned(const engine::Simulation& s) {
    std::string out;
    for (int g = 0; g < std::ssize(s.layout().groups); ++g)
        if (s.pruned(g)) out += (out.empty() ? "" : " ") + s.layout().groups[g].path.substr(2);
    return out;
}

/// Copies its input, and counts the outputs that is_read() reports as read.
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

/// A -> B -> C, A -> D with a delay, and A -> E through a connection that learns. F and G have no
/// connections.
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
    static constexpr int learning = 3;  ///< the connection that learns
};

}  // namespace

TEST_CASE("A demand for everything prunes nothing") {
    const Chain chain;
    CHECK(pruned(run(chain.system, chain.types)).empty());
    engine::Demand closed = reading(layout_of(chain.system, chain.types), {"A"});
    CHECK(pruned(build(chain.system, chain.types, closed)) == "B C D E F G");
    closed.read_everything();
    CHECK(pruned(build(chain.system, chain.types, closed)).empty());
}

TEST_CASE(
    "A group is computed when it is demanded, or when it leads to a demanded group, directly or through "
    "others") {
    const Chain chain;
    const auto pruned_for = [&](const Demanded& groups) {
        return pruned(build(chain.system, chain.types, groups));
    };
    CHECK(pruned_for({}) == "");  // a run must compute something
    CHECK(pruned_for({"C"}) == "D E F G");
    CHECK(pruned_for({"B"}) == "C D E F G");
    CHECK(pruned_for({"D", "F"}) == "B C E G");
    CHECK(pruned_for({"E", "G"}) == "B C D F");
}

TEST_CASE("A group is computed when any column of it is demanded; only the demanded columns can be read") {
    const Chain chain;
    const auto layout = layout_of(chain.system, chain.types);
    const int b = group(layout, "P/B"), c = group(layout, "P/C");
    engine::Demand demand;
    demand.read_input(b), demand.overwrite_group(c);
    auto s = build(chain.system, chain.types, demand);
    CHECK(pruned(s) == "D E F G");
    s.start();
    s.step(), s.step();
    CHECK(s.input(b, InputKind::excitatory)[0] == 1);
    CHECK_THROWS_WITH(
        s.input(c, InputKind::excitatory),
        ContainsSubstring("the input of group 'P/C' is pruned") && ContainsSubstring("Demand::read_input()"));
    s.update_groups();
    s.output(c).setConstant(7);
    CHECK_THROWS_WITH(s.output(b), ContainsSubstring("group 'P/B' is not to be overwritten") &&
                                       ContainsSubstring("Demand::overwrite_group()"));
    CHECK_THROWS_AS(s.writable_state(b, 0), std::logic_error);
    s.update_modules(), s.update_connections();
    CHECK(activity(s, "P/C")[0] == 7);
}

TEST_CASE("Groups that are read only by each other are pruned together") {
    Chain chain;
    connect(chain.system, chain.c, chain.b, InputKind::inhibitory, "synapseFixedWeight", "5");
    CHECK(pruned(build(chain.system, chain.types, {"D"})) == "B C E F G");
    CHECK(pruned(build(chain.system, chain.types, {"B"})) == "D E F G");
}

TEST_CASE("A connection of a kind that the target's type does not read leads nowhere") {
    Chain chain;
    connect(chain.system, chain.g, chain.f, InputKind::excitatory, "synapseFixedWeight", "5");
    CHECK_FALSE(layout_of(chain.system, chain.types).connections.back().effective);
    CHECK(pruned(build(chain.system, chain.types, {"F"})) == "A B C D E G");
}

TEST_CASE("The inputs of a module count as read; its outputs do when their groups are read") {
    Chain chain;
    chain.use_module(chain.b, chain.f, chain.g);
    auto s = build(chain.system, chain.types, {"G"});
    CHECK(pruned(s) == "C D E F");
    s.start();
    CHECK(*chain.asking.read == std::vector<bool>{false, true, false});
    s.step();
    CHECK(*chain.asking.read == std::vector<bool>{false, true, false});
    CHECK(s.has_written(0, 0));
    CHECK_FALSE(s.has_written(0, 1));
    CHECK_THROWS_WITH(s.module_output(0, 0), ContainsSubstring("output 'first' of process 'P' is pruned") &&
                                                 ContainsSubstring("Demand::read_output()"));
    CHECK(s.module_output(0, 1).size() == 2);
    CHECK(s.module_output(0, 2).size() == 0);  // unset
}

TEST_CASE("An output of a module can be read without its group") {
    Chain chain;
    chain.use_module(chain.a, chain.f, chain.g);
    engine::Demand demand;
    demand.read_output(0, 0);
    auto s = build(chain.system, chain.types, demand);
    CHECK(pruned(s) == "B C D E F G");
    s.start();
    CHECK(*chain.asking.read == std::vector<bool>{true, false, false});
    for (int t = 0; t < 4; ++t) s.step();
    CHECK(s.module_output(0, 0)[1] == 4);
}

TEST_CASE("All outputs of a module that are set count as read when nothing is pruned") {
    Chain chain;
    chain.use_module(chain.a, chain.f, chain.g);
    auto s = run(chain.system, chain.types);
    CHECK(*chain.asking.read == std::vector<bool>{true, true, false});
    build(chain.system, chain.types, {"F", "G"}).start();
    CHECK(*chain.asking.read == std::vector<bool>{true, true, false});
}

TEST_CASE("Demanded synapses learn as usual; other synapses to pruned groups cannot be read") {
    const Chain chain;
    auto all = run(chain.system, chain.types);
    engine::Demand demand;
    demand.read_synapses(Chain::learning);
    auto s = build(chain.system, chain.types, demand);
    CHECK(pruned(s) == "B C D F G");
    s.start();
    for (int t = 0; t < 9; ++t) all.step(), s.step();
    REQUIRE(s.synapse_state(Chain::learning, 0).size() == 2);
    CHECK((s.synapse_state(Chain::learning, 0) == all.synapse_state(Chain::learning, 0)).all());
    CHECK((activity(s, "P/E") == activity(all, "P/E")).all());

    auto without = build(chain.system, chain.types, {"A"});
    CHECK_THROWS_WITH(without.synapse_state(Chain::learning, 0),
                      ContainsSubstring("Demand::read_synapses()"));
}

TEST_CASE("Reading something pruned is an error that names it and explains how to demand it") {
    const Chain chain;
    auto s = build(chain.system, chain.types, {"B"});
    s.start();
    s.step();
    const int c = group(s.layout(), "P/C");
    const auto message = ContainsSubstring(
        "group 'P/C' is pruned: nothing that was demanded depends on it. To read it, call "
        "Demand::read_group()");
    CHECK_THROWS_WITH(s.state(c, 0), message);
    CHECK_THROWS_WITH(s.input(c, InputKind::excitatory), message);
    CHECK_THROWS_WITH(s.output(c), message);
    CHECK_THROWS_WITH(s.writable_state(c, 0), message);
    CHECK_THROWS_AS(s.state(c, 0), std::logic_error);
    CHECK(activity(s, "P/B").size() == 2);
}

TEST_CASE("A checkpoint fits only a run that prunes the same groups") {
    const Chain chain;
    const auto started = [&](const Demanded& groups) {
        auto s = build(chain.system, chain.types, groups);
        s.start();
        return s;
    };
    auto one = started({"D"}), same = started({"D"}), other = started({"C"});
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
    CHECK_THROWS_WITH(other.checkpoint(wrong), ContainsSubstring("what is pruned differs"));
}
