// The reaction of each neuron type to a NaN, and the random numbers of a group.
#include "neurons/neurons.h"

#include <cmath>
#include <limits>

#include "core/model/build.h"
#include "core/model/validate.h"
#include "neurons/tanh.h"
#include "tests/support/catch.h"

using namespace forage;

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// One group of 2 cells of a type in its first cycle: cell 0 receives NaN, cell 1 receives 5.
struct Cells {
    explicit Cells(const NeuronType& type) {
        std::vector<Eigen::ArrayXd> rings;
        for (const auto& s : type.states) rings.emplace_back(Eigen::ArrayXd::Zero(s.history * stride));
        std::vector<NeuronColumns::State> states;
        for (std::size_t i = 0; i < rings.size(); ++i)
            states.push_back({rings[i].data(), type.states[i].history});
        Eigen::ArrayXd excitation(stride), inhibition = Eigen::ArrayXd::Zero(stride),
                                           modulation = Eigen::ArrayXd::Zero(stride), scratch(stride);
        excitation << nan, 5;
        const RandomStream random(1, "group");
        NeuronColumns columns(stride, stride, 0, {excitation.data(), inhibition.data(), modulation.data()},
                              states, random, scratch.data());
        type.make()->update(columns);
        output = rings[static_cast<std::size_t>(type.output())].head(stride);
        if (type.states[0].name == "vm") potential = rings[0].head(stride);
    }
    static constexpr Index stride = 2;
    Eigen::ArrayXd output, potential;
};

}  // namespace

TEST_CASE("A NaN passes through a graded neuron, and does not make a spiking neuron spike") {
    Registry registry;
    add_neurons(registry);
    const std::map<std::string, bool> passes{{"neuronLinearThreshold", true},
                                             {"neuronSigmoid", true},
                                             {"neuronTanH", true},
                                             {"neuronNumeric", true},
                                             {"neuronLeakyIntegrator", true},
                                             {"neuronIntegrateFire", false},
                                             {"neuronPyramidApicalShunt", false},
                                             {"neuronTDValue", false},
                                             {"neuronRandomSpike", false}};
    REQUIRE(passes.size() == registry.neurons().size());
    for (const auto& [name, type] : registry.neurons()) {
        INFO(name);
        const Cells cells(type);
        CHECK(std::isnan(cells.output[0]) == passes.at(name));
        CHECK_FALSE(std::isnan(cells.output[1]));
        if (cells.potential.size()) CHECK(std::isnan(cells.potential[0]));
        if (type.name == "neuronIntegrateFire" || type.name == "neuronPyramidApicalShunt") {
            CHECK(cells.output[0] == 0);  // a spike is where vm >= threshold
            CHECK(cells.output[1] == 1);
        }
    }
}

TEST_CASE("The hyperbolic tangent leaks like the other types, and is odd around its midpoint") {
    TanH type;
    type.slope = 2;
    type.midpoint = 0.25;
    type.membrane.persistence = 0.5;
    TanH::Cell cell;
    for (const auto& [excitation, inhibition, vm] :
         {std::tuple{1.0, 0.0, 1.0}, {0.0, 0.0, 0.5}, {0.0, 0.25, 0.0}, {0.25, 0.0, 0.25}}) {
        Input in{excitation, inhibition};
        type.update(cell, in);
        CHECK(cell.vm == vm);
        CHECK(cell.act == std::tanh(2 * (vm - 0.25)));
    }
    CHECK(cell.act == 0);
}

TEST_CASE(
    "A group gets the same random numbers for the same draw of a cycle, others for another draw or cycle") {
    const RandomStream random(1, "group");
    Eigen::ArrayXd scratch(3 * NeuronColumns::scratch_columns);
    const auto draws = [&](std::uint64_t cycle, std::uint32_t draw) -> Eigen::ArrayXd {
        return NeuronColumns(3, 3, cycle, {}, {}, random, scratch.data()).uniform(draw);
    };
    CHECK((draws(5, 0) == NeuronColumns(3, 3, 5, {}, {}, random, scratch.data()).uniform()).all());
    CHECK((draws(5, 1) == draws(5, 1)).all());
    CHECK((draws(5, 0) != draws(5, 1)).all());
    CHECK((draws(5, 1) != draws(6, 1)).all());
}

TEST_CASE("The columns of several draws of one update are valid at the same time") {
    const RandomStream random(1, "group");
    constexpr int cells = 1000;
    Eigen::ArrayXd scratch(cells * NeuronColumns::scratch_columns);
    const NeuronColumns c(cells, cells, 0, {}, {}, random, scratch.data());
    const Eigen::ArrayXd first = c.uniform(0), events = c.events(0.5, 0);
    const Eigen::ArrayXd both = c.uniform(0) + c.uniform(1) + c.uniform(2) + c.uniform(3);
    CHECK(both.mean() == Approx(2).margin(0.1));
    CHECK((both - both.mean()).square().mean() ==
          Approx(4.0 / 12).margin(0.05));  // four that are independent
    const Column draw = c.uniform(0), event = c.events(0.5, 0);
    c.events(0.5, 1), c.uniform(3);
    CHECK((draw == first).all());
    CHECK((event == events).all());
}

TEST_CASE("Parameters with an unexpected meaning give warnings") {
    model::System system;
    const auto p = model::add_process(system, "P");
    const auto add = [&](const char* type, const char* parameter, const char* value) {
        const std::string name = "G" + std::to_string(model::find_process(system, p)->groups.size());
        auto& neuron = model::find_group(system, model::add_group(system, p, name, 1, 1, type))->neuron;
        model::set_parameter(neuron, parameter, value);
        return &neuron;
    };
    Registry registry;
    add_neurons(registry);
    const auto warnings = [&] {
        Diagnostics diagnostics;
        model::validate(system, registry, diagnostics);
        REQUIRE_FALSE(diagnostics.failed());
        return diagnostics.warnings();
    };
    add("neuronIntegrateFire", "spkAmpl", "1");
    add("neuronLinearThreshold", "vmMin", "2");  // not clipped: no matter
    CHECK(warnings() == 0);
    add("neuronIntegrateFire", "spkAmpl", "0.5");
    CHECK(warnings() == 1);
    auto* clipped = add("neuronSigmoid", "vmMin", "0.8");
    model::set_parameter(*clipped, "vmMax", "0.2");
    CHECK(warnings() == 1);
    model::set_parameter(*clipped, "clipVm", "true");
    CHECK(warnings() == 2);
}

TEST_CASE("A time constant is checked against the time of a cycle, which its type gets") {
    Registry registry;
    add_neurons(registry);
    model::System system;
    model::add_group(system, model::add_process(system, "P"), "A", 1, 1, "neuronLeakyIntegrator");
    auto& neuron = system.processes[0].groups[0].neuron;
    const auto found = [&](const std::string& tau) {
        model::set_parameter(neuron, "tau", tau);
        Diagnostics diagnostics;
        model::validate(system, registry, diagnostics);
        return diagnostics.all().empty() ? ""
                                         : diagnostics.all()[0].message + "; " + diagnostics.all()[0].hint;
    };
    CHECK(found("0.08").empty());
    CHECK(
        found("0.05") ==
        "tau = 0.05 s is less than two cycles of 0.04 s, so the cell cannot follow it; set cylesPerSecond to "
        "at least 40");
    CHECK(found("0") ==
          "tau = 0 is not possible; tau (Time in which a covers 63 % of a step) is a time constant: more "
          "than 0 s");
    system.cycles_per_second = 1000;
    CHECK(found("0.002").empty());
}
