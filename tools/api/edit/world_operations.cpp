#include "tools/api/edit/world_operations.h"

#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bug_interface/simulation/world.h"
#include "bug_interface/world/sdf_edit.h"
#include "bug_interface/world/sdf_reader.h"
#include "core/run/input_error.h"

namespace forage::editing {
namespace {

/// The value of a property as a text.
std::string value_of(const json& v) {
    if (v.is_boolean()) return v.get<bool>() ? "1" : "0";
    return v.is_string()   ? v.get<std::string>()
           : v.is_number() ? fmt::format("{}", v.get<double>())
                           : v.dump();
}

}  // namespace

struct WorldEdit {
    std::string& text;
    bug::ModelTexts& models;
    json o = {};  ///< the operation

    std::string id() const { return o.at("id"); }
    std::optional<double> number(const char* name) const {
        const auto it = o.find(name);
        return it == o.end() ? std::nullopt : std::optional(it->get<double>());
    }

    json add() {
        bug::NewItem item{.kind = o.at("kind"), .name = o.at("name"), .x = o.at("x"), .y = o.at("y")};
        item.yaw = o.value("yaw", item.yaw), item.width = number("width");
        item.depth = number("depth"), item.radius = number("radius");
        item.color = o.value("color", item.color), item.uri = o.value("uri", item.uri);
        std::string made;
        text = bug::add_to_world(text, std::move(item), models, made);
        return made;
    }
    json move() {
        auto moved = id();
        text = bug::moved_in_world(text, moved, o.at("x"), o.at("y"), number("yaw"), models);
        return moved;
    }
    json set() {
        auto changed = id();
        text = bug::set_in_world(text, changed, o.at("property").get<std::string>(), value_of(o.at("value")),
                                 models);
        return changed;
    }
    json unpack() {
        std::vector<std::string> made;
        text = bug::unpacked_in_world(text, id(), models, made);
        return made;
    }
    json remove() {
        text = bug::removed_from_world(text, id(), models);
        return nullptr;
    }
};

const std::vector<Operation<WorldEdit>>& world_operations() {
    using namespace schema;
    static const std::vector<Operation<WorldEdit>> all = [] {
        const Member id{"id", text()}, x{"x", number(), "in m"}, y{"y", number()};
        const Member yaw = optional("yaw", number(), nullptr, "in rad");
        return std::vector<Operation<WorldEdit>>{
            {"add",
             "Adds an item of a kind that `world_types` lists.",
             {{"kind", text()},
              x,
              y,
              optional("name", text(), ""),
              yaw,
              optional("width", number()),
              optional("depth", number()),
              optional("radius", number()),
              optional("color", text()),
              optional("uri", text())},
             &WorldEdit::add},
            {"move", "Moves an item.", {id, x, y, yaw}, &WorldEdit::move},
            {"set",
             "Sets a property of an item.",
             {id, {"property", text()}, {"value", any()}},
             &WorldEdit::set},
            {"unpack", "Writes the content of an included model into the world.", {id}, &WorldEdit::unpack},
            {"remove", "Removes an item.", {id}, &WorldEdit::remove},
        };
    }();
    return all;
}

json carry_out_in_world(const json& operation, std::string& text, bug::ModelTexts& models) {
    return carry_out(world_operations(), operation, WorldEdit{text, models});
}

void check_world(const std::string& path, const std::string& text) {
    Diagnostics diagnostics;
    bug::check_world_text(path, text, diagnostics);
    throw_errors(diagnostics);
}

Diagnostics problems_of_world(const std::string& path, const std::string& text) {
    Diagnostics diagnostics;
    if (const auto world = bug::read_world(path, diagnostics, {}, text))
        bug::World::make(*world, {}, diagnostics);
    return diagnostics;
}

}  // namespace forage::editing
