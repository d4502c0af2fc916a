#include "core/types/parameter.h"

#include <cctype>
#include <charconv>

#include "core/base/number.h"

namespace forage {
std::optional<ParameterValue> parse_parameter(ParameterKind kind, std::string_view text) {
    switch (kind) {
        case ParameterKind::boolean:
            if (text == "true") return true;
            if (text == "false") return false;
            return std::nullopt;
        case ParameterKind::real:
            if (const auto value = parse_number<double>(text)) return *value;
            return std::nullopt;
        case ParameterKind::integer:
            if (const auto value = parse_number<int>(text)) return *value;
            return std::nullopt;
        case ParameterKind::text:
            return std::string(text);
    }
    return std::nullopt;
}

std::string corrected(ParameterKind kind, std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == ' ' || c == '\t' || c == '\r' || c == '\n' || (c == '+' && out.empty())) continue;
        if (kind == ParameterKind::boolean)
            out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        else
            out += c == ',' ? '.' : c;
    }
    if (kind == ParameterKind::boolean) {
        if (out == "1" || out == "yes" || out == "on") out = "true";
        if (out == "0" || out == "no" || out == "off") out = "false";
    }
    return out != text && kind != ParameterKind::text && parse_parameter(kind, out) ? out : "";
}

bool outside(const ParameterValue& value, const std::optional<ParameterRange>& range) {
    const auto* real = std::get_if<double>(&value);
    const auto* whole = std::get_if<int>(&value);
    if (!range || (!real && !whole)) return false;
    const double v = real ? *real : *whole;
    return v < range->low || v > range->high;
}

std::string to_text(const ParameterValue& value) {
    if (const auto* b = std::get_if<bool>(&value)) return *b ? "true" : "false";
    if (const auto* s = std::get_if<std::string>(&value)) return *s;
    char buffer[32];
    const auto result = std::holds_alternative<double>(value)
                            ? std::to_chars(buffer, buffer + sizeof buffer, std::get<double>(value))
                            : std::to_chars(buffer, buffer + sizeof buffer, std::get<int>(value));
    return {buffer, result.ptr};
}

std::string_view describe(ParameterKind kind) {
    switch (kind) {
        case ParameterKind::boolean:
            return "true or false";
        case ParameterKind::real:
            return "a number";
        case ParameterKind::integer:
            return "a whole number";
        case ParameterKind::text:
            return "a text";
    }
    return "";
}

}  // namespace forage
