#include "tools/api/json_text.h"

#include <algorithm>
#include <memory>

#include "core/run/input_error.h"

namespace forage {

nlohmann::json parse_json(const std::string& text, const std::string& name) {
    using nlohmann::json;
    constexpr int deepest = 100;
    const auto not_too_deep = [](int depth, json::parse_event_t, const json&) {
        if (depth > deepest) throw InputError("too many lists and objects within each other");
        return true;
    };
    try {
        return json::parse(text, not_too_deep);
    } catch (const json::parse_error& e) {
        const std::string_view before =
            std::string_view(text).substr(0, std::max<std::size_t>(e.byte, 1) - 1);
        const auto line_start = before.rfind('\n') + 1;  // 0 without one
        Location where;
        if (!name.empty()) where.file = std::make_shared<SourceFile>(SourceFile{name, text});
        where.line = static_cast<int>(std::ranges::count(before, '\n')) + 1;
        where.column = static_cast<int>(before.size() - line_start) + 1;
        Diagnostics diagnostics;
        diagnostics.error(
            where, "this is not JSON: something else must stand here or before it",
            R"(names and texts stand in double quotes: [{"do": "rename", "id": "a", "name": "B"}])");
        throw InputError(std::move(diagnostics));
    }
}

}  // namespace forage
