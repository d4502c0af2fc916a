#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/model/lookup.h"
#include "core/model/operations.h"
#include "tools/api/edit/operations.h"

namespace forage::editing {
namespace {

using namespace model;

std::string what_is(const System& system, const std::string& id) {
    if (auto out = name_of(system, id); !out.empty()) return out;
    const auto title = [&](const std::vector<CanvasComment>& comments) {
        const auto it = std::ranges::find(comments, id, &CanvasComment::id);
        return it == comments.end() ? std::string() : fmt::format("comment '{}'", first_words(it->text));
    };
    for (const auto& p : system.processes)
        if (auto out = title(p.canvas_comments); !out.empty()) return out;
    if (auto out = title(system.canvas_comments); !out.empty()) return out;
    return "the system";
}

/// A text in an operation whose members may be wrong.
std::string text_in(const json& o, const char* member, const std::string& otherwise = {}) {
    const auto it = o.find(member);
    return it != o.end() && it->is_string() ? it->get<std::string>() : otherwise;
}

}  // namespace

std::string title_of(const json& o, const System& system) {
    const auto what = text_in(o, "do");
    const auto name = what_is(system, text_in(o, "id"));
    if (what.starts_with("add_")) return fmt::format("add {}", text_in(o, "name", what.substr(4)));
    if (what == "remove") {
        const json ids = o.value("ids", json::array());
        return ids.size() == 1 && ids.is_array() && ids[0].is_string()
                   ? "remove " + what_is(system, ids[0].get<std::string>())
                   : fmt::format("remove {} items", ids.size());
    }
    if (what == "parameter") {
        const json value = o.value("value", json());
        return fmt::format("{}.{} = {}", name, text_in(o, "name"),
                           value.is_string() ? value.get<std::string>()
                           : value.is_null() ? "its default"
                                             : value.dump());
    }
    if (what == "place") return "move " + name;
    if (what == "phantom") return "move the phantom of " + what_is(system, text_in(o, "group"));
    if (what == "comment") return "change " + name;
    if (what == "rename") return fmt::format("rename {} to {}", name, text_in(o, "name"));
    if (what == "set") return fmt::format("{} of {}", text_in(o, "property"), name);
    if (what == "use_part")
        return "add " + text_in(o, "name", std::filesystem::path(text_in(o, "file")).stem().string());
    if (what == "make_part") return fmt::format("make a part of {}", name);
    if (what == "dissolve") return "dissolve " + name;
    if (what == "paste") return "paste";
    if (what == "system") return "properties of the system";
    return fmt::format("{} of {}", what, name);
}

}  // namespace forage::editing
