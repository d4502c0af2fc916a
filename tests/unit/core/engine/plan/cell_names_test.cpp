// What cells stand for comes from the ports of modules, along the wiring.
#include "core/engine/plan/cell_names.h"

#include "tests/unit/core/engine/simulations.h"

using namespace forage;
using namespace forage::test;

namespace {

/// Obeys four cells, has an estimate of them, and senses two.
struct Wheels {
    static void describe(ModuleSpec<Wheels>& s) {
        s.name("wheels", "Wheels");
        s.input("wheels", "Wheels").names([](const auto&, const ModulePorts&, const GroupShape&) {
            return CellNames{.columns = {"left", "right"}, .rows = {"ahead", "back"}};
        });
        s.output("estimate", "Estimate").optional().same_size_as("wheels");
        s.output("senses", "Senses").optional().names({"near", "far"});
        s.output("weights", "Weights").optional().pictures("senses", "wheels");
    }
    void update(ModuleFrame&) const {}
};

/// A module with groups at its ports.
struct Robot {
    model::System system;
    Registry types = registry();
    std::string process = model::add_process(system, "P"), wheels = add("Wheels", 2, 2),
                senses = add("Senses", 2, 1), estimate = add("Estimate", 2, 2),
                weights = add("Weights", 8, 1);
    Robot() {
        types.add(module_type<Wheels>());
        model::ModuleUse use;
        use.type = "wheels";
        use.inputs = {{"wheels", wheels, {}}};
        use.outputs = {{"senses", senses, {}}, {"estimate", estimate, {}}, {"weights", weights, {}}};
        model::find_process(system, process)->module = use;
    }
    std::string add(const char* name, int width, int height) {
        return model::add_group(system, process, name, width, height, "neuronNumeric", name);
    }
    void wire(const std::string& from, const std::string& to, const model::Pattern& pattern = {}) {
        connect(system, from, to, InputKind::excitatory, "synapseFixedWeight", from + to).pattern = pattern;
    }
    CellNames names(const std::string& id) {
        Diagnostics diagnostics;
        diagnostics.lenient = true;
        const auto layout = engine::make_layout(system, types, diagnostics);
        INFO(format(diagnostics));
        REQUIRE(layout);
        return layout->groups[static_cast<std::size_t>(group(*layout, "P/" + id))].names;
    }
};

/// The cells of a row, each to one cell.
model::Pattern each_to(const std::vector<std::pair<int, int>>& targets) {
    model::TuplesPattern out;
    for (int x = 1; const auto& [column, row] : targets)
        out.tuples.push_back({{{{x++, 1, {}}}}, {{{column, row, {}}}}});
    return out;
}

}  // namespace

TEST_CASE("A group at a port has the names of the port, in a row or in a column") {
    Robot robot;
    CHECK(robot.names("Wheels").of(2, 1) == "ahead, right");
    CHECK(robot.names("Senses").columns == std::vector<std::string>{"near", "far"});
    CHECK(robot.names("Estimate") == robot.names("Wheels"));
    model::find_group(robot.system, robot.senses)->topology = model::RectTopology{1, 2};
    CHECK(robot.names("Senses").rows == std::vector<std::string>{"near", "far"});
}

TEST_CASE("Pictures, one for each cell of a group, have the names of both") {
    Robot robot;
    CHECK(robot.names("Weights").of(1, 1) == "ahead, left, near");
    CHECK(robot.names("Weights").of(8, 1) == "back, right, far");
    auto& senses = model::find_group(robot.system, robot.senses)->topology;
    senses = model::RectTopology{1, 2};
    model::find_group(robot.system, robot.weights)->topology = model::RectTopology{4, 2};
    CHECK(robot.names("Weights").of(3, 2) == "far, back, left");
}

TEST_CASE("A disabled module names nothing") {
    Robot robot;
    model::find_process(robot.system, robot.process)->module_enabled = false;
    CHECK_FALSE(robot.names("Wheels").any());
}

TEST_CASE("Cells that each drive a cell of their own have its name, through several groups") {
    Robot robot;
    const auto action = robot.add("Action", 3, 1), chosen = robot.add("Chosen", 3, 1);
    robot.wire(chosen, action);
    robot.wire(action, robot.wheels, each_to({{1, 1}, {2, 1}, {1, 2}}));
    const std::vector<std::string> expected = {"ahead, left", "ahead, right", "back, left"};
    CHECK(robot.names("Action").columns == expected);
    CHECK(robot.names("Chosen").columns == expected);
}

TEST_CASE("Cells that share a cell, or drive none, have no name") {
    Robot robot;
    const auto shared = robot.add("Shared", 3, 1), partial = robot.add("Partial", 3, 1);
    robot.wire(shared, robot.wheels, each_to({{1, 1}, {2, 1}, {1, 1}}));
    robot.wire(partial, robot.wheels, each_to({{1, 1}, {2, 1}}));
    CHECK_FALSE(robot.names("Shared").any());
    CHECK_FALSE(robot.names("Partial").any());
}

TEST_CASE("Cells that a sensor drives do not have the names of what they drive") {
    Robot robot;
    const auto stimulus = robot.add("Stimulus", 3, 1), action = robot.add("Action", 3, 1);
    robot.wire(robot.senses, stimulus, model::ForeachPattern{});
    robot.wire(stimulus, action);
    robot.wire(action, robot.wheels, each_to({{1, 1}, {2, 1}, {1, 2}}));
    CHECK(robot.names("Action").any());
    CHECK_FALSE(robot.names("Stimulus").any());
}

TEST_CASE("Inhibition carries no names") {
    Robot robot;
    const auto silent = robot.add("Silent", 2, 1);
    connect(robot.system, silent, robot.wheels, InputKind::inhibitory, "synapseFixedWeight", "c").pattern =
        each_to({{1, 1}, {2, 2}});
    CHECK_FALSE(robot.names("Silent").any());
}

TEST_CASE("A cell that is driven by cells of one name has this name") {
    Robot robot;
    const auto copy = robot.add("Copy", 2, 1), mixed = robot.add("Mixed", 2, 1);
    robot.wire(robot.senses, copy);
    robot.wire(robot.senses, mixed, model::ForeachPattern{});
    CHECK(robot.names("Copy").columns == std::vector<std::string>{"near", "far"});
    CHECK_FALSE(robot.names("Mixed").any());
}
