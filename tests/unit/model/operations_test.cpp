// What an editor does to a system.
#include "core/model/operations.h"

#include <algorithm>

#include "core/model/build.h"
#include "core/model/changes.h"
#include "core/model/lookup.h"
#include "core/model/merge.h"
#include "neurons/neurons.h"
#include "synapses/synapses.h"
#include "tests/support/catch.h"

using namespace forage;
using namespace forage::model;

namespace {

struct Small {
    System system;
    Registry registry;
    std::string p = add_process(system, "P", "p"),
                a = add_group(system, p, "A", 3, 1, "neuronLinearThreshold", "a"),
                b = add_group(system, p, "B", 3, 1, "neuronLinearThreshold", "b"),
                c = add_connection(system, a, b, InputKind::excitatory, "synapseFixedWeight", "c");
    Small() {
        add_neurons(registry), add_synapses(registry);
        place(system, a, 10, 20), place(system, b, 110, 20);
        set_line(system, c, {3, 12, std::vector<Point>{{60, 40, {}}}});
    }
};

}  // namespace

TEST_CASE("items are placed, routed, coloured and noted") {
    Small s;
    place(s.system, "p", 1, 2);
    CHECK(s.system.processes[0].icon == Icon{1, 2, 50, 50});
    set_line(s.system, "c", {.target_anchor = 5});
    CHECK(s.system.connections[0].line->source_anchor == 3);
    CHECK(s.system.connections[0].line->vertices.size() == 1);
    CHECK_THROWS_AS(set_line(s.system, "c", {.source_anchor = 16}), std::invalid_argument);
    reroute(s.system, "c", "b", "");
    CHECK((s.system.connections[0].source == "b" && s.system.connections[0].target == "b"));
    CHECK_THROWS_AS(reroute(s.system, "c", "nothing", ""), std::invalid_argument);
    CHECK_THROWS_AS(place(s.system, "c", 0, 0), std::invalid_argument);
    set_note(s.system, "a", "why"), set_color(s.system, "a", "#010203");
    CHECK(find_group(s.system, "a")->note == "why");
    set_note(s.system, "a", "");
    CHECK_FALSE(find_group(s.system, "a")->note);
}

TEST_CASE("another type keeps the parameters that it has, too") {
    Small s;
    set_parameter(s.system, "a", "threshold", "0.5"), set_parameter(s.system, "a", "excGain", "2");
    set_type(s.system, s.registry, "a", Part::neuron, "neuronRandomSpike");
    const auto& settings = find_group(s.system, "a")->neuron.settings;
    for (const auto& set : settings)
        CHECK(std::ranges::any_of(s.registry.neuron("neuronRandomSpike")->parameters,
                                  [&](const auto& p) { return p.name == set.name; }));
    CHECK(settings.size() < 2);
    CHECK_THROWS_AS(set_type(s.system, s.registry, "a", Part::neuron, "neuronNone"), std::invalid_argument);
    CHECK_THROWS_AS(set_ports(s.system, "p", {}, {}), std::invalid_argument);  // without a module
}

TEST_CASE("what is copied is pasted with new ids and names, with the connections among it") {
    Small s;
    const System one = copy(s.system, std::vector<std::string>{"a"});
    CHECK(one.connections.empty());
    const System both = copy(s.system, std::vector<std::string>{"a", "b"});
    CHECK(both.connections.size() == 1);
    CHECK(copy(s.system, std::vector<std::string>{"a", "b"}, Between::named).connections.empty());
    CHECK(copy(s.system, std::vector<std::string>{"a", "b", both.connections[0].id}, Between::named)
              .connections.size() == 1);
    const auto ids = paste(s.system, both, "p", 100, 100);
    REQUIRE(ids.size() == 3);
    CHECK(ids[0] == "CB1a");
    CHECK(find_group(s.system, ids[0])->name == "A 2");
    CHECK(find_group(s.system, ids[0])->icon->x == 100);
    CHECK(find_group(s.system, ids[1])->icon->x == 200);
    CHECK(find_connection(s.system, ids[2])->source == ids[0]);
    CHECK(find_connection(s.system, ids[2])->line->vertices[0].x == 150);
    CHECK(paste(s.system, both, "p", 0, 0)[0] == "CB2a");
    // What would lie farther out than a file can say lies on the border.
    const auto far = paste(s.system, both, "p", farthest_coordinate - 1, 0);
    CHECK(find_group(s.system, far[1])->icon->x == farthest_coordinate);
    System mixed = both;  // loose groups before whole processes, none of them with a place
    for (int i = 0; i < 8; ++i) {
        Process process;
        process.id = process.name = "more" + std::to_string(i);
        mixed.processes.push_back(process);
    }
    for (auto& g : mixed.processes[0].groups) g.icon.reset();
    const auto all = paste(s.system, mixed, "p", 10, 10);
    REQUIRE(all.size() == 11);
    CHECK(find_connection(s.system, all.back())->line->vertices[0].x ==
          both.connections[0].line->vertices[0].x);
    const auto whole = paste(s.system, copy(s.system, std::vector<std::string>{"p"}), "", 0, 0);
    CHECK(find_process(s.system, whole[0])->name == "P 2");
    CHECK_THROWS_AS(paste(s.system, both, "nothing", 0, 0), std::invalid_argument);
    CHECK_THROWS_AS(copy(s.system, std::vector<std::string>{"nothing"}), std::invalid_argument);
}

TEST_CASE("the content of a linked process is not edited") {
    Small s;
    s.system.processes[0].placeholder.push_back(s.system.processes[0]);
    s.system.processes[0].path = "p.iqrProcess";
    place(s.system, "p", 7, 7);  // its icon is in the system's file
    CHECK(s.system.processes[0].placeholder[0].icon->x == 7);
    CHECK_THROWS_AS(place(s.system, "a", 0, 0), std::invalid_argument);
    CHECK_THROWS_AS(set_parameter(s.system, "a", "threshold", "1"), std::invalid_argument);
}

TEST_CASE("a run needs only parameters, or is built anew, or does not notice") {
    Small s;
    const System before = s.system;
    place(s.system, "a", 0, 0), set_note(s.system, "b", "note"), set_line(s.system, "c", {1, 1, {}});
    auto changes = parameter_changes(before, s.system, s.registry);
    REQUIRE(changes);
    CHECK(changes->empty());
    set_parameter(s.system, "a", "threshold", "0.5"), set_parameter(s.system, "c", "weight", "2");
    changes = parameter_changes(before, s.system, s.registry);
    REQUIRE(changes);
    REQUIRE(changes->size() == 2);
    CHECK((*changes)[0].text == "P/A.threshold=0.5");
    CHECK((*changes)[1].text == "A to B.weight=2");
    const auto back = parameter_changes(s.system, before, s.registry);
    CHECK(std::get<double>((*back)[1].value) == 1);  // its default
    set_delay(s.system, "c", {UniformFunction{1}, {}});
    CHECK_FALSE(parameter_changes(before, s.system, s.registry));
}

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

TEST_CASE("comments on a page are added, changed, copied, pasted and removed") {
    Small s;
    const auto one = add_canvas_comment(s.system, "p", {"", "one", "", {10, 10, 50, 20}, {}});
    const auto all = add_canvas_comment(s.system, {}, {"", "all", "", {0, 0, 50, 20}, {}});
    CHECK((one == "comment" && all == "comment-2"));
    CHECK_THROWS_AS(add_canvas_comment(s.system, "none", {}), std::invalid_argument);
    CHECK_THROWS_AS(add_canvas_comment(s.system, "p", {"a", "", "", {}, {}}), std::invalid_argument);
    place(s.system, one, 20, 30), set_color(s.system, one, "#123456");
    set_comment(s.system, one, {.text = "One", .width = 70});
    CHECK(*find_canvas_comment(s.system, one) == CanvasComment{one, "One", "#123456", {20, 30, 70, 20}, {}});
    CHECK_THROWS_AS(set_comment(s.system, one, {.height = 0}), std::invalid_argument);
    CHECK_THROWS_AS(set_comment(s.system, one, {.text = std::string("a\0b", 3)}), std::invalid_argument);
    CHECK_NOTHROW(set_comment(s.system, one, {.text = "One\n\ttwo"}));
    CHECK_THROWS_AS(set_comment(s.system, "a", {}), std::invalid_argument);
    auto changes = parameter_changes(Small().system, s.system, s.registry);
    CHECK((changes && changes->empty()));

    // Onto the page that is named, with groups or without.
    const System copied = copy(s.system, std::vector{one, all, std::string("a")});
    const auto ids = paste(s.system, copied, "p", 100, 100);
    REQUIRE(ids.size() == 3);
    CHECK(s.system.processes[0].canvas_comments.size() == 3);
    CHECK(find_group(s.system, ids[0])->icon->x == 110);
    CHECK(find_canvas_comment(s.system, ids[1])->box.x == 120);
    CHECK(paste(s.system, copy(s.system, std::vector{one}), "", 0, 0).size() == 1);
    CHECK(s.system.canvas_comments.size() == 2);
    // With a process, its own comments go along, and those of the system stay beside it.
    const auto whole = paste(s.system, copy(s.system, std::vector{std::string("p"), all}), "p", 0, 0);
    CHECK(find_process(s.system, whole[0])->canvas_comments.size() == 3);
    CHECK(s.system.canvas_comments.size() == 3);
    remove(s.system, one), remove(s.system, all);
    CHECK(s.system.processes[0].canvas_comments.size() == 2);
    CHECK(s.system.canvas_comments.size() == 2);
    CHECK_THROWS_AS(remove(s.system, one), std::invalid_argument);
}

TEST_CASE("phantoms have places, and vertices stay on the pages on which they are") {
    Small s;
    add_process(s.system, "Q", "q"), add_process(s.system, "R", "r");
    add_group(s.system, "q", "C", 1, 1, "neuronLinearThreshold", "far");
    add_group(s.system, "r", "D", 1, 1, "neuronLinearThreshold", "farther");
    CHECK_THROWS_AS(place_phantom(s.system, "q", "far", 1, 1), std::invalid_argument);
    CHECK_THROWS_AS(place_phantom(s.system, "q", "none", 1, 1), std::invalid_argument);
    const auto c = add_connection(s.system, "a", "far", InputKind::excitatory, "synapseFixedWeight");
    place_phantom(s.system, "p", "far", 1, 2), place_phantom(s.system, "p", "far", 3, 4);
    place_phantom(s.system, "q", "a", 5, 6);
    CHECK(s.system.processes[0].phantoms == std::vector<Phantom>{{"far", 3, 4}});
    const std::vector<Point> bend{{1, 1, {}}};
    set_line(s.system, c, {.vertices = bend, .source_vertices = bend, .target_vertices = bend});
    const auto line = [&] { return *find_connection(s.system, c)->line; };
    reroute(s.system, c, "b", "");
    CHECK((line().vertices == bend && line().source_vertices == bend && line().target_vertices == bend));
    reroute(s.system, c, "", "farther");
    CHECK((line().vertices.empty() && line().source_vertices == bend && line().target_vertices.empty()));
    reroute(s.system, c, "", "a");
    CHECK((line().vertices.empty() && line().source_vertices.empty()));
    reroute(s.system, "c", "", "far");  // it had a vertex on its page
    CHECK(find_connection(s.system, "c")->line->vertices.empty());
    remove(s.system, "c");
    CHECK((s.system.processes[0].phantoms.empty() && s.system.processes[1].phantoms.empty()));

    // What the file says of a linked process is in its placeholder.
    Small linked;
    add_process(linked.system, "Q", "q");
    reroute(linked.system, "c", "", add_group(linked.system, "q", "C", 1, 1, "neuronLinearThreshold", "far"));
    Process& q = linked.system.processes[1];
    q.placeholder.push_back(q);
    place_phantom(linked.system, "q", "a", 5, 6);
    CHECK(q.placeholder.front().phantoms == std::vector<Phantom>{{"a", 5, 6}});
    remove(linked.system, "c");
    CHECK(q.placeholder.front().phantoms.empty());

    // A copied process keeps phantoms of what is copied with it.
    const auto d = add_connection(s.system, "a", "far", InputKind::excitatory, "synapseFixedWeight");
    set_line(s.system, d, {.vertices = bend, .source_vertices = bend});
    place_phantom(s.system, "p", "far", 3, 4);
    place(s.system, "p", 0, 0), place(s.system, "q", 10, 0);
    System target;
    paste(target, copy(s.system, std::vector<std::string>{"p", "q"}), "", 100, 100);
    CHECK(target.processes[0].phantoms == std::vector<Phantom>{{"CB1far", 3, 4}});
    CHECK(target.connections.back().line->vertices[0].x == 101);
    CHECK(target.connections.back().line->source_vertices == bend);
    CHECK(extract_process(s.system, "p").process.phantoms.empty());
    // Groups without their process leave its page.
    const auto loose = copy(s.system, std::vector<std::string>{"a", "far"});
    CHECK(
        (loose.connections[0].line->vertices.empty() && loose.connections[0].line->source_vertices.empty()));
    System joined = s.system;
    join(joined, s.system);
    CHECK(joined.processes[3].phantoms == std::vector<Phantom>{{"S2_far", 3, 4}});
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

TEST_CASE("messages name a text by its first words, without a part of a character") {
    CHECK(first_words(" Why ") == "Why");
    CHECK(first_words("Why\nnot") == "Why...");
    CHECK(first_words("0123456789012345678901234567890ö and more") == "0123456789012345678901234567890...");
    CHECK(first_words("012345678901234567890123456789ö and more") == "012345678901234567890123456789ö...");
}
