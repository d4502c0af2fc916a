#include "tools/api/edit/world_operations.h"

#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bug_interface/world/sdf_edit.h"
#include "core/run/input_error.h"

namespace forage::editing {
namespace {

std::optional<double> number_in(const json& o, const char* name) {
    const auto it = o.find(name);
    return it == o.end() || it->is_null() ? std::nullopt : std::optional(it->get<double>());
}

/// The value of a property as a text.
std::string value_of(const json& v) {
    if (v.is_boolean()) return v.get<bool>() ? "1" : "0";
    return v.is_string()   ? v.get<std::string>()
           : v.is_number() ? fmt::format("{}", v.get<double>())
                           : v.dump();
}

}  // namespace

json carry_out_in_world(const json& o, std::string& text, bug::ModelTexts& models) {
    const auto what = o.at("do").get<std::string>();
    if (what == "add") {
        bug::NewItem item{.kind = o.at("kind"), .name = o.value("name", ""), .x = o.at("x"), .y = o.at("y")};
        item.yaw = o.value("yaw", item.yaw), item.width = number_in(o, "width");
        item.depth = number_in(o, "depth"), item.radius = number_in(o, "radius");
        item.color = o.value("color", item.color), item.uri = o.value("uri", item.uri);
        std::string id;
        text = bug::add_to_world(text, std::move(item), models, id);
        return id;
    }
    if (what != "move" && what != "set" && what != "unpack" && what != "remove")
        throw InputError(fmt::format("there is no operation '{}'", what), "add, move, set, unpack or remove");
    auto id = o.at("id").get<std::string>();
    if (what == "move") {
        text = bug::moved_in_world(text, id, o.at("x"), o.at("y"), number_in(o, "yaw"), models);
    } else if (what == "set") {
        const auto property = o.at("property").get<std::string>();
        text = bug::set_in_world(text, id, property, value_of(o.at("value")), models);
    } else if (what == "unpack") {
        std::vector<std::string> ids;
        text = bug::unpacked_in_world(text, id, models, ids);
        return ids;
    } else {
        text = bug::removed_from_world(text, id, models);
        return nullptr;
    }
    return id;
}

void check_world(const std::string& path, const std::string& text) {
    Diagnostics diagnostics;
    bug::check_world_text(path, text, diagnostics);
    throw_errors(diagnostics);
}

}  // namespace forage::editing
