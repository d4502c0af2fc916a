// Small systems that are built and run.
#pragma once

#include "core/engine/simulation.h"
#include "core/model/build.h"
#include "neurons/neurons.h"
#include "synapses/synapses.h"
#include "tests/support/catch.h"
#include "tests/support/echo.h"

namespace forage::test {

/// act = act of the cycle before + 1: 1, 2, 3... Delays of its connections must not change that.
struct Counter {
    struct Cell {
        double act = 0;
    };
    static void describe(NeuronSpec<Counter>& s) {
        s.name("counter", "Counter").output("act", &Cell::act, "Activity");
    }
    void update(Cell& c, const Input&) const { c.act += 1; }
};

/// act = 1.
struct One {
    struct Cell {
        double act = 0;
    };
    static void describe(NeuronSpec<One>& s) { s.name("one", "One").output("act", &Cell::act, "Activity"); }
    void update(Cell& c, const Input&) const { c.act = 1; }
};

inline Registry registry() {
    Registry r;
    add_neurons(r);
    add_synapses(r);
    r.add(neuron_type<Counter>());
    r.add(neuron_type<One>());
    r.add(module_type<Echo>());
    return r;
}

/// Built leniently, and started.
inline engine::Simulation run(const model::System& system, const Registry& types,
                              engine::Simulation::Options options = {}) {
    Diagnostics diagnostics;
    diagnostics.lenient = true;
    auto simulation =
        engine::Simulation::build(system, types, engine::Demand::everything(), options, diagnostics);
    INFO(format(diagnostics));
    REQUIRE(simulation);
    simulation->start();
    return std::move(*simulation);
}

inline int group(const engine::Layout& layout, std::string_view path) {
    for (int g = 0; g < std::ssize(layout.groups); ++g)
        if (layout.groups[g].path == path) return g;
    FAIL("no group " << path);
    return -1;
}
inline int group(const engine::Simulation& s, std::string_view path) { return group(s.layout(), path); }

inline Eigen::ArrayXd state(const engine::Simulation& s, std::string_view path, std::string_view name) {
    const int g = group(s, path);
    for (int i = 0; i < static_cast<int>(s.layout().groups[g].type.states.size()); ++i)
        if (s.layout().groups[g].type.states[static_cast<std::size_t>(i)].name == name) return s.state(g, i);
    FAIL("no state " << name);
    return {};
}

inline Eigen::ArrayXd activity(const engine::Simulation& s, std::string_view path) {
    const int g = group(s, path);
    return s.state(g, s.layout().groups[g].type.output());
}

inline model::DistanceFunction uniform(double v) { return {model::UniformFunction{v}, {}}; }

/// Adds a connection, and gives it back to be changed until the next one is added.
inline model::Connection& connect(model::System& s, const std::string& from, const std::string& to,
                                  InputKind kind, const std::string& type, const std::string& id = {}) {
    return *model::find_connection(s, model::add_connection(s, from, to, kind, type, id));
}

}  // namespace forage::test
