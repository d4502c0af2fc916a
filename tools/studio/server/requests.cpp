#include "tools/studio/server/requests.h"

#include <algorithm>
#include <random>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/base/number.h"
#include "core/run/input_error.h"
#include "tools/api/edit/json_text.h"
#include "tools/studio/server/pages.h"
#include "tools/studio/server/problems.h"

namespace forage::studio {
namespace {

constexpr std::size_t max_containers = 200'000, max_values = 1'000'000;  ///< in a message

/// The member `id` of a message that is not parsed; null when it is no whole number.
json id_in(std::string_view message) {
    constexpr std::string_view blanks = " \t\r\n";
    int depth = 0;
    for (std::size_t i = 0; i < message.size(); ++i) {
        depth += message[i] == '[' || message[i] == '{' ? 1 : message[i] == ']' || message[i] == '}' ? -1 : 0;
        if (message[i] != '"') continue;
        const auto begin = i++;
        for (; i < message.size() && message[i] != '"'; ++i) i += message[i] == '\\' ? 1 : 0;
        if (depth != 1 || message.substr(begin, i - begin) != "\"id") continue;
        auto value = message.substr(std::min(message.find_first_not_of(blanks, i + 1), message.size()));
        if (!value.starts_with(':')) continue;
        value.remove_prefix(std::min(value.find_first_not_of(blanks, 1), value.size()));
        const auto number = parse_number<std::int64_t>(value.substr(0, value.find_first_of(",} \t\r\n")));
        return number ? json(*number) : json(nullptr);
    }
    return nullptr;
}

int digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

std::string decoded(std::string_view text) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '+') {
            out += ' ';
        } else if (text[i] == '%' && i + 2 < text.size() && digit(text[i + 1]) >= 0 &&
                   digit(text[i + 2]) >= 0) {
            out += static_cast<char>(16 * digit(text[i + 1]) + digit(text[i + 2]));
            i += 2;
        } else {
            out += text[i];
        }
    }
    return out;
}

}  // namespace

std::optional<std::string> refusal_of(std::string_view message) {
    try {
        const auto size = size_of_json(message);
        check_depth(size);
        if (size.containers > max_containers || size.containers + size.commas > max_values)
            throw InputError(
                "there is too much in this message",
                fmt::format("at most {} lists and objects, and {} values", max_containers, max_values));
        return std::nullopt;
    } catch (const InputError& e) {
        return Pages::text({{"type", "reply"},
                            {"id", id_in(message)},
                            {"ok", false},
                            {"problems", problems_of(e.diagnostics())}});
    }
}

std::string make_token() {
    std::random_device device;
    std::string out;
    for (int i = 0; i < 4; ++i) out += fmt::format("{:08x}", device());
    return out;
}

bool is_from_here(std::string_view host, std::string_view origin, std::uint16_t port) {
    for (const char* name : {"127.0.0.1", "localhost"}) {
        const std::string here = fmt::format("{}:{}", name, port);
        if (host == here) return origin.empty() || origin == "http://" + here;
    }
    return false;
}

std::string query_value(std::string_view target, std::string_view name) {
    const auto mark = target.find('?');
    if (mark == target.npos) return {};
    target.remove_prefix(mark + 1);
    while (!target.empty()) {
        const auto end = std::min(target.find('&'), target.size());
        const std::string_view pair = target.substr(0, end);
        if (pair.substr(0, pair.find('=')) == name && pair.find('=') != pair.npos)
            return decoded(pair.substr(name.size() + 1));
        target.remove_prefix(std::min(end + 1, target.size()));
    }
    return {};
}

std::string token_in(std::string_view message) {
    const auto parsed = nlohmann::json::parse(message, nullptr, false);
    const auto found = parsed.is_object() ? parsed.find("token") : parsed.end();
    return found != parsed.end() && found->is_string() ? found->get<std::string>() : std::string();
}

}  // namespace forage::studio
