// What an editor does to a system.
#include "core/model/operations.h"

#include <algorithm>

#include "core/model/changes.h"
#include "core/model/lookup.h"
#include "tests/support/catch.h"
#include "tests/unit/core/model/small_system.h"

using namespace forage;
using namespace forage::model;

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

TEST_CASE("messages name a text by its first words, without a part of a character") {
    CHECK(first_words(" Why ") == "Why");
    CHECK(first_words("Why\nnot") == "Why...");
    CHECK(first_words("0123456789012345678901234567890ö and more") == "0123456789012345678901234567890...");
    CHECK(first_words("012345678901234567890123456789ö and more") == "012345678901234567890123456789ö...");
}
