#include "core/plugin/declarations.h"

#include <filesystem>
#include <fstream>

#include <unistd.h>

#include "core/base/output_files.h"
#include "core/base/text_file.h"
#include "core/types/registry.h"
#include "tests/support/catch.h"
#include "tests/support/paths.h"

using namespace forage;

namespace {

struct Mine {
    bool on = true;
    double gain = 0.1;
    int count = -3;
    std::string file = "a.txt";
    static void describe(NeuronSpec<Mine>& s) {
        s.name("neuronMine", "Mine").doc("Says \"what\" it does.").reads(InputKind::inhibitory);
        s.param("on", &Mine::on);
        s.param("gain", &Mine::gain).label("Gain").unit("mV").range(-1, 1e300).doc("A factor.");
        s.param("count", &Mine::count).at_start();
        s.param("file", &Mine::file).path();
        s.feedback("vm", "Membrane", 3, 0.25).output("act", "Activity");
    }
    void update(NeuronColumns&) const {}
};

struct Plastic {
    double rate = 1;
    struct Synapse {
        double weight = 0.5;
    };
    struct Target {
        double post = 0;
    };
    static void describe(SynapseSpec<Plastic>& s) {
        s.name("synapseMine", "Mine").param("rate", &Plastic::rate);
        s.state("weight", &Synapse::weight, "Weight").output("psp", "Potential");
        s.feedback("post", &Target::post, "Target", false).event_driven();
    }
    double output(const Synapse& s, double pre, const Target&) const { return s.weight * pre; }
};

struct Device {
    int port = 1;
    static void describe(ModuleSpec<Device>& s) {
        s.name("moduleMine", "Mine").param("port", &Device::port);
        s.input("in", "In").size(3, 2);
        s.output("out", "Out").optional().doc("What it says.");
    }
    void update(ModuleFrame&) {}
};

/// A plugin as a file, and its declarations beside it.
struct Built {
    Built() {
        types.neurons.push_back(neuron_type<Mine>());
        types.synapses.push_back(synapse_type<Plastic>());
        types.modules.push_back(module_type<Device>());
        write_file(plugin, "the code");
        write(plugin::declarations(types, plugin));
    }
    ~Built() {
        std::filesystem::remove(plugin);
        std::filesystem::remove(plugin::declarations_path(plugin));
    }
    Built(const Built&) = delete;
    void write(const std::string& text) const { write_file(plugin::declarations_path(plugin), text); }
    auto read() const { return plugin::read_declarations(plugin); }

    PluginTypes types;
    std::string plugin = test::temporary_path("mine.so").string();
};

void same(const std::vector<Parameter>& a, const std::vector<Parameter>& b) {
    REQUIRE(a.size() == b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        CHECK((a[i].name == b[i].name && a[i].label == b[i].label && a[i].doc == b[i].doc));
        CHECK((a[i].unit == b[i].unit && a[i].kind == b[i].kind && a[i].is_path == b[i].is_path));
        CHECK((a[i].default_value == b[i].default_value && a[i].at_start == b[i].at_start));
        REQUIRE(a[i].range.has_value() == b[i].range.has_value());
        if (a[i].range) CHECK((a[i].range->low == b[i].range->low && a[i].range->high == b[i].range->high));
    }
}

}  // namespace

TEST_CASE("Types are read as they were declared") {
    const Built built;
    const auto read = built.read();
    REQUIRE(read);
    const auto& neuron = read->neurons.at(0);
    CHECK((neuron.name == "neuronMine" && neuron.doc == "Says \"what\" it does." && !neuron.elementwise));
    CHECK(neuron.reads == built.types.neurons[0].reads);
    same(neuron.parameters, built.types.neurons[0].parameters);
    REQUIRE(neuron.states.size() == 2);
    CHECK((neuron.states[0].history == 3 && neuron.states[0].initial == 0.25 && neuron.states[0].feedback));
    CHECK(neuron.output() == 1);
    const auto& synapse = read->synapses.at(0);
    same(synapse.parameters, built.types.synapses[0].parameters);
    CHECK((synapse.event_driven && !synapse.has_gain && synapse.output() == 1));
    CHECK((synapse.states[0].initial == 0.5 && !synapse.feedback.at(0).required));
    const auto& module = read->modules.at(0);
    CHECK((module.ports.at(0).size.text == "3 x 2 cells" && module.ports.at(1).is_output));
    CHECK((module.ports[1].optional && module.ports[1].doc == "What it says." && module.checkpoints));
    Registry registry;
    registry.add(neuron), registry.add(synapse), registry.add(module);
}

TEST_CASE("Objects of declared types hold parameters, and do not run") {
    const Built built;
    const auto read = built.read();
    REQUIRE(read);
    const auto one = read->neurons[0].make(), other = read->neurons[0].make();
    const auto& gain = read->neurons[0].parameters[1];
    gain.set(one->parameters(), 0.5);
    CHECK(gain.get(one->parameters()) == ParameterValue(0.5));
    CHECK(gain.get(other->parameters()) == ParameterValue(0.1));
    CHECK_THROWS_AS(read->synapses[0].make()->gain(), std::logic_error);
}

TEST_CASE("Declarations of another build, of another SDK or none at all are not read") {
    const Built built;
    const std::string text = read_file(plugin::declarations_path(built.plugin));
    write_file(built.plugin, "other code");
    CHECK_FALSE(built.read());
    write_file(built.plugin, "the code");
    CHECK(built.read());
    built.write("{\"sdk\": 1" + text.substr(text.find(',')));
    CHECK_FALSE(built.read());
    std::filesystem::remove(plugin::declarations_path(built.plugin));
    CHECK_FALSE(built.read());
}

TEST_CASE("Damaged declarations are not read, and do no harm") {
    const Built built;
    const std::string text = read_file(plugin::declarations_path(built.plugin));
    for (std::size_t at = 0; at < text.size() - 2; at += 7) {
        built.write(text.substr(0, at));
        CHECK_FALSE(built.read());
        for (const char* instead : {"[", "\"", "-", "1e99", "null,", "}"}) {
            std::string damaged = text;
            damaged.replace(at, 3, instead);
            built.write(damaged);
            const auto read = built.read();
            if (read && !read->neurons.empty()) read->neurons[0].make();
        }
    }
    for (const auto& [what, instead] :
         std::vector<std::pair<std::string, std::string>>{{"\"history\": 3", "\"history\": 2000000000"},
                                                          {"\"history\": 3", "\"history\": 0"},
                                                          {"\"history\": 3", "\"history\": 3.5"},
                                                          {"\"default\": -3", "\"default\": 4000000000"},
                                                          {"\"kind\": \"real\"", "\"kind\": \"complex\""},
                                                          {"\"default\": true", "\"default\": 1"}}) {
        CAPTURE(instead);
        std::string wrong = text;
        REQUIRE(wrong.find(what) != std::string::npos);
        wrong.replace(wrong.find(what), what.size(), instead);
        built.write(wrong);
        CHECK_FALSE(built.read());
    }
    built.write(std::string(1'000'000, '['));
    CHECK_FALSE(built.read());
}
