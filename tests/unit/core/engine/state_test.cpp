// Simulations that are stopped and continued, and numbers that are not finite. tests/property tries random
// systems.
#include <cmath>
#include <limits>

#include "tests/unit/core/engine/simulations.h"

using namespace forage;
using namespace forage::test;

namespace {

/// Counts its updates, and declares that to checkpoints or not.
template <bool declared>
struct Counting {
    double gain = 1;
    int count = 0;
    static void describe(ModuleSpec<Counting>& s) {
        s.name("counting", "Counting").any_ports();
        s.param("gain", &Counting::gain);
    }
    void update(ModuleFrame& frame) { frame.output(0) = gain * ++count; }
    void checkpoint(Archive& archive) requires declared { archive(count); }
};

/// Cell 2 becomes infinite in cycle 5.
struct Bursting {
    double value = std::numeric_limits<double>::infinity();
    static void describe(NeuronSpec<Bursting>& s) {
        s.name("bursting", "Bursting").state("vm", "Potential").output("act", "Activity");
    }
    void update(NeuronColumns& c) const {
        c.state(1) = 1;
        if (c.cycle() == 5) c.state(0)[2] = value;
    }
};

NeuronType bursting(double value) {
    auto type = neuron_type<Bursting>();
    type.make = [value, make = type.make] {
        auto made = make();
        static_cast<Bursting*>(made->parameters())->value = value;
        return made;
    };
    return type;
}

template <bool declared>
struct CountingSystem {
    model::System system;
    Registry types = registry();
    CountingSystem() {
        types.add(module_type<Counting<declared>>());
        const auto p = model::add_process(system, "P");
        const auto a = model::add_group(system, p, "A", 2, 1, "neuronNumeric");
        model::ModuleUse use;
        use.type = "counting", use.outputs = {{"out", a, {}}};
        model::find_process(system, p)->module = use;
    }
};

}  // namespace

TEST_CASE("A checkpoint contains members of modules and changed parameters") {
    const CountingSystem<true> s;
    auto one = run(s.system, s.types), other = run(s.system, s.types);
    for (int t = 0; t < 5; ++t) one.step();
    Diagnostics diagnostics;
    const auto change = model::parse_assignment(s.system, s.types, "P.gain=10", "--schedule", diagnostics);
    REQUIRE(change);
    one.set(*change);
    Archive out;
    one.checkpoint(out);
    Archive in{std::string_view(out.bytes())};
    other.checkpoint(in);
    CHECK(other.cycle() == 5);
    one.step(), other.step();
    CHECK(one.module_output(0, 0)[0] == 60);
    CHECK(other.module_output(0, 0)[0] == 60);
}

TEST_CASE("A module type that does not declare its members cannot be part of a checkpoint") {
    const CountingSystem<false> s;
    auto simulation = run(s.system, s.types);
    Archive out;
    CHECK_THROWS_WITH(simulation.checkpoint(out),
                      ContainsSubstring("counting of process 'P' cannot be part"));
}

TEST_CASE("A checkpoint of another system is refused") {
    const CountingSystem<true> s;
    auto one = run(s.system, s.types);
    model::System other_system;
    model::add_group(other_system, model::add_process(other_system, "P"), "A", 3, 1, "neuronNumeric");
    auto other = run(other_system, s.types);
    Archive out;
    one.checkpoint(out);
    Archive in{std::string_view(out.bytes())};
    CHECK_THROWS_AS(other.checkpoint(in), ArchiveError);
}

TEST_CASE("A checkpoint of another seed is refused") {
    const CountingSystem<true> s;
    auto one = run(s.system, s.types, {.seed = 1}), other = run(s.system, s.types, {.seed = 2});
    Archive out;
    one.checkpoint(out);
    Archive in{std::string_view(out.bytes())};
    CHECK_THROWS_WITH(other.checkpoint(in), ContainsSubstring("the seed differs"));
}

TEST_CASE("The digest of a state depends on its numbers, but not on the sign of a NaN") {
    model::System system;
    model::add_group(system, model::add_process(system, "P"), "A", 3, 1, "bursting");
    const auto written = [&](double value, Archive::Nan nan) {
        Registry types = registry();
        types.add(bursting(value));
        auto simulation = run(system, types);
        for (int t = 0; t < 9; ++t) simulation.step();
        Archive out(nan);
        simulation.checkpoint(out);
        return out.bytes();
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    using enum Archive::Nan;
    CHECK(written(nan, all_the_same) == written(-nan, all_the_same));
    CHECK(written(nan, as_it_is) != written(-nan, as_it_is));  // a run continues with the same bits
    CHECK(written(0.0, all_the_same) != written(-0.0, all_the_same));
    CHECK(written(1.5, all_the_same) == written(1.5, as_it_is));
}

TEST_CASE("The search for numbers that are not finite finds the first one with any number of threads") {
    for (const double value :
         {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
          std::numeric_limits<double>::quiet_NaN()})
        for (const int threads : {1, 4}) {
            Registry types = registry();
            types.add(bursting(value));
            model::System s;
            const auto p = model::add_process(s, "P");
            for (const char* name : {"A", "B", "C"}) model::add_group(s, p, name, 40, 1, "one");
            for (const char* name : {"D", "E"}) model::add_group(s, p, name, 40, 1, "bursting");
            auto simulation =
                run(s, types, {.threads = threads, .parallel_threshold_ns = 0, .min_task_ns = 0});
            simulation.check_finite(true);
            for (int t = 0; t < 9; ++t) simulation.step();
            REQUIRE(simulation.not_finite());
            const auto& found = *simulation.not_finite();
            CHECK(simulation.layout().groups[found.group].type.name == "bursting");
            for (int g = 0; g < found.group; ++g) CHECK(simulation.layout().groups[g].type.name == "one");
            CHECK(found.state == 0);
            CHECK(found.cell == 2);
            CHECK(found.cycle == 5);
            CHECK((std::isnan(value) ? std::isnan(found.value) : found.value == value));

            auto careless = run(s, types);
            for (int t = 0; t < 9; ++t) careless.step();
            CHECK_FALSE(careless.not_finite());
        }
}
