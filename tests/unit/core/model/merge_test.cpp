// Two edits of one system are merged.
#include "core/model/merge.h"

#include "core/model/lookup.h"
#include "tests/support/catch.h"
#include "tests/unit/core/model/small_system.h"

using namespace forage;
using namespace forage::model;

TEST_CASE("changes of different things are merged, and others are conflicts") {
    Small s;
    const System base = s.system;
    System mine = base, theirs = base;
    set_parameter(mine, "a", "threshold", "0.5");
    set_parameter(theirs, "a", "excGain", "2"), rename(theirs, "b", "Theirs");
    add_group(mine, "p", "New", 1, 1, "neuronLinearThreshold", "n");
    auto merged = merge(base, mine, theirs);
    CHECK(merged.conflicts.empty());
    CHECK(find_group(merged.system, "a")->neuron.settings.size() == 2);
    CHECK(find_group(merged.system, "b")->name == "Theirs");
    CHECK(find_group(merged.system, "n"));
    rename(mine, "b", "Mine");
    CHECK(merge(base, mine, theirs).conflicts == std::vector<std::string>{"the name of group 'B'"});
    remove(theirs, "a");
    merged = merge(base, mine, theirs);
    CHECK(merged.conflicts.size() == 2);
    System gone = base;
    remove(gone, "a");
    CHECK(merge(base, gone, base).system == gone);
}

TEST_CASE("a type that one side changed and parameters that the other side changed are a conflict") {
    Small s;
    const std::vector<std::string> both{"the type of group 'A' or its parameters"};
    System base = s.system;
    set_parameter(base, "a", "threshold", "0.1");
    System other_type = base, other_value = base, other_note = base;
    set_type(other_type, s.registry, "a", Part::neuron, "neuronRandomSpike");
    set_parameter(other_value, "a", "threshold", "0.5");
    CHECK(merge(base, other_value, other_type).conflicts == both);
    CHECK(merge(base, other_type, other_value).conflicts == both);
    // What one side alone has changed is taken as a whole, and a note fits every type.
    find_group(other_note, "a")->neuron.note = "why";
    for (Merge merged : {merge(base, other_type, other_note), merge(base, other_note, other_type)}) {
        CHECK(merged.conflicts.empty());
        const auto& neuron = find_group(merged.system, "a")->neuron;
        CHECK((neuron.type == "neuronRandomSpike" && neuron.settings.empty() && neuron.note == "why"));
    }
    System third_type = base;
    set_type(third_type, s.registry, "a", Part::neuron, "neuronSigmoid");
    CHECK(merge(base, third_type, other_type).conflicts == both);
    // Both changed the type in the same way: parameters are merged one by one.
    System mine = other_type, theirs = other_type;
    set_parameter(mine, "a", "probability", "0.5"), set_parameter(theirs, "a", "spkAmpl", "0.5");
    auto same = merge(base, mine, theirs);
    CHECK(same.conflicts.empty());
    CHECK(find_group(same.system, "a")->neuron.settings.size() == 2);
}

TEST_CASE("cross references belong to a type, too") {
    Small s;
    System base = s.system;
    base.processes[0].module.emplace().type = "moduleOne";
    base.connections[0].synapse->type = "synapseHebbian";
    System other_type = base, other_ports = base;
    other_type.processes[0].module->type = "moduleTwo";
    other_type.connections[0].synapse->type = "synapseFixedWeight";
    other_ports.processes[0].module->inputs = {{"in", "a", {}}};
    other_ports.connections[0].synapse->feedback = {{"postact", "vm", {}}};
    for (const auto& merged : {merge(base, other_ports, other_type), merge(base, other_type, other_ports)})
        CHECK(merged.conflicts ==
              std::vector<std::string>{"the type of the module of process 'P' or its parameters",
                                       "the type of the synapse of connection 'A to B' or its parameters"});
}

TEST_CASE("a merge takes hosts, ports and the properties of the system from both sides") {
    Small s;
    System base = s.system;
    base.processes[0].hostname = "localhost", base.processes[0].port = "1", base.port = "54923";
    for (const bool outside : {false, true}) {
        System one = base, other = base;
        one.processes[0].hostname = "robot", one.processes[0].port = "2", one.port = "54924";
        one.date = "today", one.author = "me", one.cycles_per_second = 50, one.sync_plots = true;
        other.processes[0].name = "Q", other.note = "of the other";
        System both = one;
        both.processes[0].name = "Q", both.note = "of the other";
        const auto merged = outside ? merge(base, other, one) : merge(base, one, other);
        CHECK(merged.conflicts.empty());
        CHECK(merged.system == both);
    }
    System mine = base, theirs = base;
    mine.processes[0].port = "2", theirs.processes[0].port = "3", mine.port = "7", theirs.port = "8";
    CHECK(merge(base, mine, theirs).conflicts ==
          std::vector<std::string>{"the port of the system", "the port of process 'P'"});
}

TEST_CASE("comments and phantoms are merged, too") {
    Small s;
    add_process(s.system, "Q", "q");
    add_group(s.system, "q", "C", 1, 1, "neuronLinearThreshold", "far");
    add_connection(s.system, "a", "far", InputKind::excitatory, "synapseFixedWeight", "across");
    const auto id = add_canvas_comment(s.system, "p", {"", "Why it\nis so", "", {10, 10, 50, 20}, {}});
    const System base = s.system;
    System mine = base, theirs = base;
    place(mine, id, 1, 1), place_phantom(mine, "p", "far", 1, 2);
    set_comment(theirs, id, {.text = "other"}), add_canvas_comment(theirs, {}, {"", "all", "", {}, {}});
    auto merged = merge(base, mine, theirs);
    CHECK(merged.conflicts.empty());
    CHECK((find_canvas_comment(merged.system, id)->text == "other" &&
           find_canvas_comment(merged.system, id)->box.x == 1));
    CHECK(merged.system.canvas_comments.size() == 1);
    CHECK(merged.system.processes[0].phantoms.size() == 1);
    set_comment(mine, id, {.text = "mine"});
    CHECK(merge(base, mine, theirs).conflicts ==
          std::vector<std::string>{"the text of the comment 'Why it...'"});
    remove(theirs, "far");
    CHECK(merge(base, mine, theirs).system.processes[0].phantoms.empty());
}
