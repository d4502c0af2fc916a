// World files are edited in their author's text.
#include "bug_interface/world/sdf_edit.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "bug_interface/motion/reset.h"
#include "bug_interface/simulation/world_queries.h"
#include "bug_interface/world/sdf_reader.h"
#include "core/base/output_files.h"
#include "core/base/text_file.h"
#include "tests/support/catch.h"
#include "tests/support/paths.h"

using namespace forage;
using namespace forage::bug;
namespace paths = forage::test;
namespace fs = std::filesystem;

namespace {

std::vector<fs::path> worlds() {
    std::vector<fs::path> out;
    for (const auto& folder : {paths::source_dir() / "systems", paths::shared_dir() / "original"})
        if (fs::exists(folder))
            for (const auto& entry : fs::recursive_directory_iterator(folder))
                if (entry.path().extension() == ".world") out.push_back(entry.path());
    std::ranges::sort(out);
    return out;
}

std::size_t lines(const std::string& text) {
    return static_cast<std::size_t>(std::ranges::count(text, '\n'));
}

/// The number of lines that differ, when both have as many.
std::size_t different_lines(const std::string& a, const std::string& b) {
    std::size_t out = 0;
    for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
        const auto to = std::min(a.find('\n', i), a.size()), end = std::min(b.find('\n', j), b.size());
        out += a.substr(i, to - i) != b.substr(j, end - j);
        i = to + 1, j = end + 1;
    }
    return out;
}

/// The world as it is read; the models are those of the file's place.
WorldDescription read_text_of_world(const fs::path& beside, const std::string& text) {
    const auto file = beside.parent_path() / ("." + beside.stem().string() + "-edit-test.world");
    write_file(file.string(), text);
    Diagnostics diagnostics;
    auto world = read_world(file.string(), diagnostics, {});
    fs::remove(file);
    INFO(format(diagnostics));
    REQUIRE(world);
    return *world;
}

/// All collisions of a world in its frame, in order: what bodies and rays meet.
std::vector<Pose> places_of_collisions(const WorldDescription& world) {
    std::vector<Pose> out;
    for (const auto& model : world.models)
        for (const auto& link : model.links)
            for (const auto& c : link.collisions) out.push_back(model.pose * link.pose * c.pose);
    return out;
}

/// Another value that fits a property.
std::string other_value(const ItemProperty& p) {
    if (p.kind == "text") return "A <new> & name";
    if (p.kind == "boolean") return p.value == "1" ? "0" : "1";
    if (p.kind == "color") return p.value == "#3366cc" ? "#336699" : "#3366cc";
    if (p.kind == "choice") return p.choices.front() == p.value ? p.choices.back() : p.choices.front();
    if (p.kind == "integer") return std::to_string(std::stoi(p.value) + 1);
    const double v = std::stod(p.value);
    return p.high && v + 0.5 > *p.high ? std::to_string((*p.low + v) / 2) : std::to_string(v + 0.5);
}

const WorldItem& find_item(const std::vector<WorldItem>& items, std::string_view id) {
    const auto it = std::ranges::find(items, id, &WorldItem::id);
    REQUIRE(it != items.end());
    return *it;
}

const ItemProperty& find_property(const WorldItem& item, std::string_view name) {
    const auto it = std::ranges::find(item.properties, name, &ItemProperty::name);
    INFO(item.id << " " << name);
    REQUIRE(it != item.properties.end());
    return *it;
}

}  // namespace

TEST_CASE("everything in every world is found, moved and removed, and nothing else changes") {
    CHECK(worlds().size() >= 8);
    for (const auto& file : worlds()) {
        INFO(file.string());
        const std::string text = read_file(file.string());
        ModelTexts models(file.string());
        const auto items = items_of_world(text, models);
        CHECK(items.size() > 3);
        CHECK(items.front().kind == "world");
        for (const auto& item : items) {
            INFO(item.id);
            CHECK(item.kind != "other");
            CHECK_FALSE(item.properties.empty());
            CHECK(std::ranges::count(items, item.id, &WorldItem::id) == 1);
            if (item.placed) {
                const auto moved = moved_in_world(text, item.id, item.x + 0.5, item.y, std::nullopt, models);
                CHECK(lines(moved) <= lines(text) + 1);
                if (lines(moved) == lines(text)) CHECK(different_lines(text, moved) <= 1);
                const auto after = items_of_world(moved, models);
                CHECK(find_item(after, item.id).x == Approx(item.x + 0.5).margin(1e-6));
                CHECK(find_item(after, item.id).yaw == Approx(item.yaw).margin(1e-9));
                CHECK(find_item(after, item.id).kind == item.kind);
            }
            if (item.kind == "world") continue;
            const auto rest = items_of_world(removed_from_world(text, item.id, models), models);
            const auto sites = std::ranges::count(items, "site", &WorldItem::kind);
            CHECK(rest.size() ==
                  items.size() - 1 - static_cast<std::size_t>(item.kind == "game" ? sites : 0));
        }
    }
}

TEST_CASE("every property of everything in every world takes another value, which is read back", "[long]") {
    for (const auto& file : worlds()) {
        INFO(file.string());
        const std::string text = read_file(file.string());
        ModelTexts models(file.string());
        for (const auto& item : items_of_world(text, models))
            for (const auto& p : item.properties) {
                INFO(item.id << " " << p.name << " " << p.value);
                std::string id = item.id;
                CHECK(set_in_world(text, id, p.name, p.value, models) == text);  // no change, no other byte
                const auto wanted = other_value(p);
                INFO(wanted);
                const auto changed = set_in_world(text, id, p.name, wanted, models);
                Diagnostics diagnostics;
                check_world_text(file.string(), changed, diagnostics);
                INFO(format(diagnostics));
                CHECK_FALSE(diagnostics.failed());
                const auto after = items_of_world(changed, models);
                const auto& now = find_property(find_item(after, id), p.name).value;
                if (p.kind == "number")
                    CHECK(std::stod(now) == Approx(std::stod(wanted)).margin(0.02));
                else
                    CHECK(now == wanted);
                // The other items are unchanged.
                for (const auto& other : items_of_world(text, models))
                    if (other.id != item.id && p.name != "name")  // repeated names are numbered
                        CHECK(find_item(after, other.id).parts.size() == other.parts.size());
            }
    }
}

TEST_CASE(
    "every kind of item is added to every world and edited, and the world without it has the bytes of "
    "before",
    "[long]") {
    for (const auto& file : worlds()) {
        INFO(file.string());
        const std::string text = read_file(file.string());
        ModelTexts models(file.string());
        const auto before = items_of_world(text, models);
        for (const auto& [kind, title, group] : kinds_of_items()) {
            INFO(kind);
            CHECK((!title.empty() && !group.empty()));
            std::string id;
            const bool single =
                kind == "sun" || kind == "game" || kind == "trials" || kind == "floor" || kind == "home";
            std::string more;
            try {
                more =
                    add_to_world(text, {.kind = std::string(kind), .name = "", .x = 1, .y = 2}, models, id);
            } catch (const std::invalid_argument&) {
                CHECK(single);  // the world has one
                continue;
            }
            INFO(id);
            const auto items = items_of_world(more, models);
            const bool game =
                kind == "site" && std::ranges::find(before, "game", &WorldItem::kind) == before.end();
            const bool ground = kind == "start" && items.size() == before.size() + 2;
            CHECK(items.size() == before.size() + (game || ground ? 2 : 1));
            const auto& item = find_item(items, id);
            const std::string expected = kind == "pillar" || kind == "wall"  ? "wall"
                                         : kind == "disc"                    ? "patch"
                                         : kind == "ball" || kind == "crate" ? "object"
                                         : kind == "goal"                    ? "light"
                                                                             : std::string(kind);
            if (kind != "model") CHECK(item.kind == expected);
            if (item.placed) CHECK((item.x == 1 && item.y == 2));
            for (const auto& p : item.properties) {
                INFO(p.name);
                std::string other = id;
                Diagnostics diagnostics;
                check_world_text(file.string(), set_in_world(more, other, p.name, other_value(p), models),
                                 diagnostics);
                INFO(format(diagnostics));
                CHECK_FALSE(diagnostics.failed());
            }
            if (ground) more = removed_from_world(more, "GroundPlane", models);
            CHECK(removed_from_world(more, game ? "Game" : id, models) == text);
        }
    }
}

TEST_CASE("an unpacked world is the same world, in which each wall can be edited") {
    for (const auto& file : worlds()) {
        INFO(file.string());
        std::string text = read_file(file.string());
        ModelTexts models(file.string());
        const auto before = read_text_of_world(file, text);
        for (;;) {
            const auto items = items_of_world(text, models);
            const auto it = std::ranges::find_if(items, &WorldItem::unpacks);
            if (it == items.end()) break;
            INFO(it->id);
            std::vector<std::string> ids;
            text = unpacked_in_world(text, it->id, models, ids);
            CHECK_FALSE(ids.empty());
        }
        const auto after = read_text_of_world(file, text);
        const auto places = places_of_collisions(before), now = places_of_collisions(after);
        REQUIRE(places.size() == now.size());
        for (std::size_t i = 0; i < places.size(); ++i) CHECK(places[i].isApprox(now[i], 1e-6));
        CHECK((before.sun.has_value() == after.sun.has_value()));
        for (const auto& item : items_of_world(text, models))
            if (item.kind == "wall") {
                INFO(item.id);
                CHECK(item.parts.size() >= 1);
                find_property(item, "color");
            }
    }
}

TEST_CASE("a tilt that a quaternion says stays when its model is split, and when its part is turned") {
    const auto file = paths::source_dir() / "systems/worlds/basic_arena.world";
    ModelTexts models(file.string());
    const std::string box =
        "<collision name='c'><geometry><box><size>1 2 0.1</size></box></geometry></collision>";
    // Rolled by 0.3, then turned by 0.4.
    std::string text =
        "<sdf version='1.6'><world name='w'><model name='Ramps'><pose>1 0 0 0 0 0.5</pose><static>1</static>"
        "<link name='a'><pose rotation_format='quat_xyzw'>1 2 0.5 0.146459319 0.029688774 0.196438488 "
        "0.969061487</pose>" +
        box +
        "</link>"
        "<link name='b'><pose>0 0 0.5 0 0.2 0</pose>" +
        box + "</link></model></world></sdf>";
    const auto before = places_of_collisions(read_text_of_world(file, text));
    std::vector<std::string> ids;
    const auto split = unpacked_in_world(text, "Ramps", models, ids);
    CHECK(ids == std::vector<std::string>{"Ramps_a", "Ramps_b"});
    const auto after = places_of_collisions(read_text_of_world(file, split));
    REQUIRE(after.size() == before.size());
    for (std::size_t i = 0; i < before.size(); ++i) CHECK(after[i].isApprox(before[i], 1e-6));

    const auto world = [&](const std::string& pose) {
        return "<sdf version='1.6'><world name='w'><model name='Ramp'><pose" + pose +
               "</pose><static>1</static><link name='a'>" + box + "</link></model></world></sdf>";
    };
    const auto turned = moved_in_world(
        world(" rotation_format='quat_xyzw'>1 2 0.5 0.146459319 0.029688774 0.196438488 0.969061487"), "Ramp",
        1, 2, 1.0, models);
    const auto wanted = places_of_collisions(read_text_of_world(file, world(">1 2 0.5 0.3 0 1")));
    const auto now = places_of_collisions(read_text_of_world(file, turned));
    REQUIRE(now.size() == 1);
    CHECK(now[0].isApprox(wanted[0], 1e-6));
}

TEST_CASE("an edited world is read as what it says") {
    const auto file = paths::source_dir() / "systems/worlds/basic_arena.world";
    std::string text = read_file(file.string()), id;
    ModelTexts models(file.string());
    text = add_to_world(text, {.kind = "wall", .name = "East", .x = 2, .y = 0, .yaw = 1.5, .width = 3},
                        models, id);
    text = add_to_world(
        text,
        {.kind = "patch", .name = "Red", .x = 1, .y = 1, .width = 0.5, .depth = 0.5, .color = "#ff0000"},
        models, id);
    text = add_to_world(text, {.kind = "ball", .name = "Ball", .x = 0.5, .y = 1, .radius = 0.1}, models, id);
    text = set_in_world(text, id, "radius", "0.2", models);
    text = add_to_world(text, {.kind = "light", .name = "Lamp", .x = -1, .y = 1}, models, id);
    text = moved_in_world(text, "Bug", 0.25, -1.5, 0.5, models);
    text = set_in_world(text, id = "Bug", "color", "#00ff00", models);
    text = set_in_world(text, id = "GroundPlane", "width", "6", models);
    text = removed_from_world(text, "Wall", models);
    const auto world = read_text_of_world(file, text);
    const auto find = [&](const char* wanted) {
        const auto* out = find_model(world, wanted);
        INFO(wanted);
        REQUIRE(out);
        return out;
    };
    CHECK_FALSE(find_model(world, "Wall"));
    CHECK(find("East")->is_static);
    CHECK(find("East")->links.front().visuals.front().material.diffuse.maxCoeff() < 0.25f);  // on grey floors
    CHECK(find("Red")->links.front().collisions.empty());
    const auto* ball = find("Ball");
    CHECK_FALSE(ball->is_static);
    CHECK(ball->links.front().collisions.front().shape.size.x() == Approx(0.4));
    CHECK(ball->links.front().pose.translation().z() == Approx(0.2));  // still on the floor
    const auto* bug = find("Bug");
    CHECK(bug->pose.translation().x() == Approx(0.25));
    CHECK(yaw_of(bug->pose) == Approx(0.5));
    const auto& visuals = bug->links.front().visuals;
    CHECK(visuals.at(0).material.diffuse.isApprox(Colour(0, 1, 0)));
    CHECK(visuals.at(1).material.diffuse.isApprox(Colour(0.7f, 0.7f, 0.7f)));  // its front stays grey
    CHECK(bug->links.front().range_sensors.size() == 2);
    CHECK(bug->plugins.size() == 2);
    CHECK(find("GroundPlane")->links.front().collisions.back().shape.size.x() == Approx(6));
    CHECK_FALSE(find("GroundPlane")->links.front().visuals.front().material.texture.empty());
}

TEST_CASE("a start pose brings the bounds that end trials, once, and leaves the floor its colour") {
    const auto file = paths::source_dir() / "systems/worlds/empty_floor.world";
    std::string text = read_file(file.string()), id;
    ModelTexts models(file.string());
    text = add_to_world(text, {.kind = "wall", .name = "", .x = 4, .width = 1}, models, id);
    text = add_to_world(text, {.kind = "home", .name = "", .x = -7}, models, id);  // its radius is 3
    text = add_to_world(text, {.kind = "start", .name = "", .x = 0, .y = -6}, models, id);
    CHECK(id == "Reset_0");
    text = add_to_world(text, {.kind = "start", .name = "", .x = 1}, models, id);
    const auto world = read_text_of_world(file, text);
    const auto* ground = find_model(world, "GroundPlane");
    REQUIRE(ground);
    CHECK(ground->links.front().visuals.empty());  // the floor that was there stays in sight
    Diagnostics diagnostics;
    const auto plan = find_reset(world, diagnostics);
    INFO(format(diagnostics));
    REQUIRE(plan);
    CHECK(plan->starts.size() == 2);
    CHECK(plan->bounds.contains(Eigen::Vector2d(4.5, -6.5)));
    CHECK(plan->bounds.contains(Eigen::Vector2d(-10, 0)));
    CHECK(plan->bounds.sizes().y() < 14);
    for (const auto& d : drawing_of(world)) CHECK(d.solid.pose.translation().z() > -0.5);  // no bounds
}

TEST_CASE("what cannot be done to a world is said") {
    const auto file = paths::source_dir() / "systems/worlds/basic_arena.world";
    const std::string text = read_file(file.string());
    ModelTexts models(file.string());
    std::string id;
    std::vector<std::string> ids;
    const auto set = [&](const char* item, const char* property, const char* value) {
        return set_in_world(text, id = item, property, value, models);
    };
    CHECK_THROWS_AS(moved_in_world(text, "Nothing", 0, 0, 0, models), std::invalid_argument);
    CHECK_THROWS_AS(moved_in_world(text, "Sun", 0, 0, 0, models), std::invalid_argument);
    CHECK_THROWS_AS(add_to_world(text, {.kind = "tree", .name = ""}, models, id), std::invalid_argument);
    CHECK_THROWS_AS(add_to_world(text, {.kind = "wall", .name = "Bug"}, models, id), std::invalid_argument);
    CHECK_THROWS_AS(add_to_world(text, {.kind = "sun", .name = ""}, models, id), std::invalid_argument);
    CHECK_THROWS_AS(add_to_world(text, {.kind = "start", .name = "", .x = 2.495}, models, id),
                    std::invalid_argument);
    CHECK_NOTHROW(add_to_world(text, {.kind = "start", .name = "", .x = 2.48, .y = -2}, models, id));
    CHECK_THROWS_AS(add_to_world(text, {.kind = "patch", .name = "", .color = "red"}, models, id),
                    std::invalid_argument);
    CHECK_THROWS_AS(set("Wall", "width", "0"), std::invalid_argument);
    CHECK_THROWS_AS(set("Wall", "width", "wide"), std::invalid_argument);
    CHECK_THROWS_AS(set("Wall", "wheels", "4"), std::invalid_argument);
    CHECK_THROWS_AS(set("Wall", "name", "Bug"), std::invalid_argument);
    CHECK_THROWS_AS(set("Wall", "color", "blue"), std::invalid_argument);
    CHECK_THROWS_AS(removed_from_world(text, "basic_arena", models), std::invalid_argument);
    CHECK_THROWS_AS(unpacked_in_world(text, "basic_arena", models, ids), std::invalid_argument);
}

TEST_CASE("a name may hold the quotes of the author, and an empty material is painted") {
    ModelTexts models("none.world");
    std::string text =
        "<sdf version=\"1.5\"><world name=\"w\">\n<model name='Box'><pose>1 1 0 0 0 0</pose>"
        "<static>true</static><link name='l'><visual name='v'><geometry><box><size>1 1 1</size></box>"
        "</geometry><material/></visual></link></model>\n</world></sdf>\n";
    std::string id = "Box";
    text = set_in_world(text, id, "color", "#ff0000", models);
    text = set_in_world(text, id, "name", "Tom's \"box\"", models);
    CHECK(id == "Tom's \"box\"");
    Diagnostics diagnostics;
    check_world_text("w.world", text, diagnostics);
    INFO(format(diagnostics) << text);
    CHECK_FALSE(diagnostics.failed());
    const auto items = items_of_world(text, models);
    REQUIRE(items.size() == 2);
    REQUIRE(items[1].parts.size() == 1);
    CHECK(items[1].name == id);
    CHECK(items[1].parts[0].color == "#ff0000");
}

TEST_CASE("An edit of a model that <state> places changes its pose and its name there") {
    const std::string text =
        "<sdf version='1.6'><world name='w'><model name='Box'><pose>1 0 0 0 0 0</pose><link "
        "name='l'/></model>"
        "<state world_name='w'><model name='Box'><pose>2 3 0 0 0 0</pose><link name='l'><pose>2 3 0 0 0 "
        "0</pose>"
        "</link></model></state></world></sdf>";
    ModelTexts models("a.world");
    CHECK(items_of_world(text, models)[1].x == 2);
    CHECK_THAT(moved_in_world(text, "Box", 4, 5, {}, models),
               ContainsSubstring("<model name='Box'><pose>4 5 0 0 0 0</pose></model></state>"));
    std::string id = "Box";
    CHECK_THAT(set_in_world(text, id, "name", "Crate", models),
               ContainsSubstring("<state world_name='w'><model name=\"Crate\">"));
    CHECK_THAT(removed_from_world(text, "Box", models), !ContainsSubstring("Box"));
}

TEST_CASE("A model that is placed relative to another has no place that could be moved") {
    const auto text = [](const char* frame) {
        return fmt::format(
            "<sdf version='1.9'><world name='w'><model name='Box'><pose relative_to='{}'>1 0 0 0 0 0"
            "</pose><link name='l'/></model><frame name='f'/></world></sdf>",
            frame);
    };
    ModelTexts models("a.world");
    CHECK(items_of_world(text("world"), models)[1].placed);
    CHECK_FALSE(items_of_world(text("f"), models)[1].placed);
    CHECK_NOTHROW(moved_in_world(text("world"), "Box", 4, 5, {}, models));
    CHECK_THROWS_AS(moved_in_world(text("f"), "Box", 4, 5, {}, models), std::invalid_argument);
}

TEST_CASE("A model is a robot or a resource also when it is merged from another one") {
    const auto world = paths::source_dir() / "systems/worlds/basic_arena.world";
    const std::string text =
        "<sdf version=\"1.9\"><world name=\"w\">"
        "<model name=\"Mine\"><include merge=\"true\"><uri>model://forage_bug</uri></include></model>"
        "<model name=\"Other\"><include><uri>model://forage_bug</uri></include></model>"
        "</world></sdf>";
    ModelTexts models(world.string());
    const auto items = items_of_world(text, models);
    CHECK(find_item(items, "Mine").kind == "robot");
    CHECK(find_item(items, "Other").kind == "object");
}
