// When modules read and write, and in which order inputs are summed.
#include <algorithm>

#include "tests/unit/core/engine/simulations.h"

using namespace forage;
using namespace forage::test;

namespace {

struct Log {
    int starts = 0;
    std::vector<double> seen;  ///< first cell of the first input, at start and in each update
};

/// Writes 100 at start and `cycle` + 1 in cycles 0, 3, 6...
struct Writer {
    std::shared_ptr<Log> log;
    static void describe(ModuleSpec<Writer>& s) { s.name("writer", "Writer").any_ports(); }
    void start(const ModulePorts&, ModuleFrame& frame) {
        ++log->starts;
        log->seen.push_back(frame.input(0).sum());
        frame.output(0) = 100;
    }
    void update(ModuleFrame& frame) {
        log->seen.push_back(frame.input(0)[0]);
        if (frame.cycle() % 3 == 0) frame.output(0) = static_cast<double>(frame.cycle()) + 1;
    }
};

/// Writes a constant.
struct Say {
    double value = 0;
    static void describe(ModuleSpec<Say>& s) {
        s.name("say", "Say").any_ports();
        s.param("value", &Say::value);
    }
    void update(ModuleFrame& frame) { frame.output(0) = value; }
};

void use_module(model::System& s, const std::string& process, const std::string& type,
                std::vector<model::CrossReference> inputs, std::vector<model::CrossReference> outputs) {
    model::ModuleUse use;
    use.type = type, use.inputs = std::move(inputs), use.outputs = std::move(outputs);
    model::find_process(s, process)->module = use;
}

struct WriterSystem {
    model::System system;
    Registry types = registry();
    std::shared_ptr<Log> log = std::make_shared<Log>();
    std::string process;
    WriterSystem() {
        process = model::add_process(system, "P");
        const auto a = model::add_group(system, process, "A", 2, 1, "counter"),
                   b = model::add_group(system, process, "B", 2, 1, "neuronNumeric");
        use_module(system, process, "writer", {{"in", a, {}}}, {{"out", b, {}}});
        types.add(module_type(Writer{log}));
    }
};

std::string text(double v) { return to_text(ParameterValue(v)); }

}  // namespace

TEST_CASE(
    "A module reads this cycle's activity; what it writes is received in the next cycle, and held until "
    "written again") {
    WriterSystem w;
    auto s = run(w.system, w.types);
    const double received[] = {100, 1, 1, 1, 4, 4, 4, 7};  // what start() wrote, in cycle 0
    for (int t = 0; t < 8; ++t) {
        s.step();
        CHECK(activity(s, "P/B")[1] == received[t]);
    }
    CHECK(w.log->starts == 1);
    CHECK(w.log->seen == std::vector<double>{0, 1, 2, 3, 4, 5, 6, 7, 8});  // at start: zeros
}

TEST_CASE("A disabled module is neither started nor updated") {
    WriterSystem w;
    model::find_process(w.system, w.process)->module_enabled = false;
    auto s = run(w.system, w.types);
    for (int t = 0; t < 3; ++t) s.step();
    CHECK(s.layout().modules.empty());
    CHECK(w.log->starts == 0);
    CHECK(w.log->seen.empty());
    CHECK(activity(s, "P/B")[0] == 0);
}

TEST_CASE("A simulation that is not started does not step") {
    WriterSystem w;
    Diagnostics diagnostics;
    auto s = engine::Simulation::build(w.system, w.types, engine::Demand::everything(), {}, diagnostics);
    REQUIRE(s);
    CHECK_THROWS_AS(s->step(), engine::RunError);
    s->start();
    CHECK_NOTHROW(s->step());
}

TEST_CASE("Inputs are summed from modules first, then from connections, in byte order of ids") {
    // 1e16 + 1 is 1e16: whatever order is wrong shows in one of the permutations.
    std::array<double, 4> values{-1e16, 1, 1, 1e16};
    Registry types = registry();
    types.add(module_type<Say>());
    int lossy = 0;
    do {
        model::System system;
        const auto q = model::add_process(system, "Q", "q");
        const auto a = model::add_group(system, q, "A", 1, 1, "one"),
                   b = model::add_group(system, q, "B", 1, 1, "neuronNumeric");
        const auto weigh = [&](const char* id, double value) {
            model::set_parameter(
                *connect(system, a, b, InputKind::excitatory, "synapseFixedWeight", id).synapse, "weight",
                text(value));
        };
        weigh("9", values[3]), weigh("10", values[2]);  // not in order
        for (const int i : {1, 0}) {
            const auto p = model::add_process(system, "P" + std::to_string(i), "p" + std::to_string(i));
            use_module(system, p, "say", {}, {{"out", b, {}}});
            model::set_parameter(*model::find_process(system, p)->module, "value",
                                 text(values[static_cast<std::size_t>(i)]));
        }
        auto s = run(system, types);
        s.step(), s.step();
        const double sum = (((0 + values[0]) + values[1]) + values[2]) + values[3];
        CHECK(activity(s, "Q/B")[0] == sum);
        lossy += sum != 2;
    } while (std::next_permutation(values.begin(), values.end()));
    CHECK(lossy == 8);  // of 12
}

TEST_CASE("Groups, modules and connections are in byte order of their ids, not in file order") {
    model::System system;
    std::string last;
    for (const std::string id : {"b", "B", "a", "9", "10"}) {
        const auto p = model::add_process(system, "P" + id, "p" + id);
        last = model::add_group(system, p, "G", 1, 1, "neuronNumeric", "g" + id);
        use_module(system, p, "moduleEcho", {{"in", last, {}}}, {{"out", last, {}}});
        connect(system, last, last, InputKind::excitatory, "synapseFixedWeight", "c" + id);
    }
    const Registry types = registry();
    const auto s = run(system, types);
    const auto& layout = s.layout();
    REQUIRE((layout.groups.size() == 5 && layout.modules.size() == 5 && layout.connections.size() == 5));
    const char* order[] = {"10", "9", "B", "a", "b"};
    for (int i = 0; i < 5; ++i) {
        CHECK(layout.groups[i].id == std::string("g") + order[i]);
        CHECK(layout.modules[i].process == std::string("P") + order[i]);
        CHECK(layout.connections[i].id == std::string("c") + order[i]);
    }
}
