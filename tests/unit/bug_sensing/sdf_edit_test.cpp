// World files are edited in their author's text.
#include "bug_interface/world/sdf_edit.h"

#include <algorithm>
#include <filesystem>

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

}  // namespace

TEST_CASE("what stands in a world is moved, added and removed, in every file, and nothing else changes") {
    CHECK(worlds().size() >= 5);
    for (const auto& file : worlds()) {
        INFO(file.string());
        const std::string text = read_file(file.string());
        const auto items = items_of_world(text);
        CHECK(items.size() > 2);
        for (const auto& item : items) {
            INFO(item.name);
            if (std::ranges::count(items, item.name, &WorldItem::name) > 1)
                continue;  // repeated in an original
            const auto moved = moved_in_world(text, item.name, item.x + 0.5, item.y, std::nullopt);
            CHECK(lines(moved) <= lines(text) + 1);
            if (lines(moved) == lines(text)) CHECK(different_lines(text, moved) <= 1);
            const auto after = items_of_world(moved);
            const auto it = std::ranges::find(after, item.name, &WorldItem::name);
            CHECK(it->x == Approx(item.x + 0.5).margin(1e-6));
            CHECK(it->yaw == Approx(item.yaw).margin(1e-9));
            CHECK(it->kind == item.kind);
            CHECK(items_of_world(removed_from_world(text, item.name)).size() == items.size() - 1);
            if (!item.size.empty()) {
                auto size = item.size;
                size.front() *= 2;
                const auto other = items_of_world(resized_in_world(text, item.name, size));
                CHECK(std::ranges::find(other, item.name, &WorldItem::name)->size == size);
            }
            CHECK(items_of_world(renamed_in_world(text, item.name, "A <new> name")).size() == items.size());
        }
        for (const auto& kind : kinds_of_items()) {
            std::string name;
            const auto more = add_to_world(text, {.kind = kind, .name = "", .x = 1, .y = 2}, name);
            INFO(kind << " " << name);
            Diagnostics diagnostics;
            check_world_text(file.string(), more, diagnostics);
            CHECK_FALSE(diagnostics.failed());
            CHECK(items_of_world(more).size() == items.size() + 1);
            CHECK(removed_from_world(more, name) == text);
        }
    }
}

TEST_CASE("an edited world is read as what it says") {
    const auto folder = fs::temp_directory_path() / "forage-sdf-edit";
    fs::create_directories(folder);
    std::string text = read_file((paths::source_dir() / "systems/worlds/basic_arena.world").string()), name;
    text = add_to_world(text, {.kind = "wall", .name = "East", .x = 2, .y = 0, .yaw = 1.5, .width = 3}, name);
    text = add_to_world(
        text,
        {.kind = "patch", .name = "Red", .x = 1, .y = 1, .width = 0.5, .depth = 0.5, .color = "#ff0000"},
        name);
    text = add_to_world(text, {.kind = "ball", .name = "Ball", .x = 0.5, .y = 1, .radius = 0.1}, name);
    text = moved_in_world(text, "Bug", 0.25, -1.5, 0.5);
    text = removed_from_world(text, "Wall");
    write_file((folder / "edited.world").string(), text);
    Diagnostics diagnostics;
    const auto world = read_world((folder / "edited.world").string(), diagnostics,
                                  {(paths::source_dir() / "systems/worlds/models").string()});
    INFO(format(diagnostics));
    REQUIRE(world);
    const auto find = [&](const char* wanted) {
        const auto it = std::ranges::find(world->models, wanted, &Model::name);
        return it == world->models.end() ? nullptr : &*it;
    };
    CHECK_FALSE(find("Wall"));
    REQUIRE((find("East") && find("Red") && find("Ball") && find("Bug")));
    CHECK(find("East")->is_static);
    CHECK(find("Red")->links.front().collisions.empty());
    CHECK_FALSE(find("Ball")->is_static);
    CHECK(find("Bug")->pose.translation().x() == Approx(0.25));
    fs::remove_all(folder);
}

TEST_CASE("what cannot be done to a world is said") {
    const std::string text = read_file((paths::source_dir() / "systems/worlds/basic_arena.world").string());
    std::string name;
    CHECK_THROWS_AS(moved_in_world(text, "Nothing", 0, 0, 0), std::invalid_argument);
    CHECK_THROWS_AS(add_to_world(text, {.kind = "tree", .name = ""}, name), std::invalid_argument);
    CHECK_THROWS_AS(add_to_world(text, {.kind = "wall", .name = "Bug"}, name), std::invalid_argument);
    CHECK_THROWS_AS(add_to_world(text, {.kind = "patch", .name = "", .color = "red"}, name),
                    std::invalid_argument);
    CHECK_THROWS_AS(resized_in_world(text, "Wall", {1, 1}), std::invalid_argument);
    CHECK_THROWS_AS(renamed_in_world(text, "Wall", "Bug"), std::invalid_argument);
}
