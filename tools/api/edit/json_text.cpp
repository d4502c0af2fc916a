#include "tools/api/edit/json_text.h"

#include <algorithm>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/run/input_error.h"

namespace forage {

namespace {

using nlohmann::json;

constexpr std::size_t max_depth = 100;

/// The mistake at a byte of a text, from 1.
InputError mistake(const std::string& text, const std::string& name, std::size_t byte) {
    Location where =
        location_of(std::make_shared<SourceFile>(SourceFile{name, text}), std::max<std::size_t>(byte, 1) - 1);
    if (name.empty()) where.file = nullptr;
    Diagnostics out;
    out.error(where, "this is not JSON: something else must stand here or before it",
              "names and texts stand in double quotes");
    return InputError(std::move(out));
}

}  // namespace

JsonSize size_of_json(std::string_view text) {
    JsonSize out;
    std::size_t depth = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '[' || c == '{')
            ++out.containers, out.depth = std::max(out.depth, ++depth);
        else if (c == ']' || c == '}')
            depth -= depth > 0 ? 1 : 0;
        else if (c == ',')
            ++out.commas;
        else if (c == '"')
            for (++i; i < text.size() && text[i] != '"'; ++i) i += text[i] == '\\' ? 1 : 0;
    }
    return out;
}

void check_depth(const JsonSize& size) {
    if (size.depth > max_depth)
        throw InputError("too many lists and objects within each other",
                         fmt::format("at most {}", max_depth));
}

json parse_json(const std::string& text, const std::string& name) {
    try {
        check_depth(size_of_json(text));
        return json::parse(text);
    } catch (const json::parse_error& e) {
        throw mistake(text, name, e.byte);
    } catch (const json::out_of_range&) {
        throw InputError("a number is too large");
    }
}

void check_json(const std::string& text, const std::string& name) { parse_json(text, name); }

std::vector<std::string> elements_of(const std::string& list) {
    std::vector<std::string> out;
    for (const auto& each : json::parse(list))
        if (!each.is_null()) out.push_back(each.is_string() ? each.get<std::string>() : each.dump());
    return out;
}

}  // namespace forage
