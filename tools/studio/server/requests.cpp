#include "tools/studio/server/requests.h"

#include <algorithm>
#include <charconv>
#include <random>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/run/input_error.h"
#include "tools/api/edit/json_text.h"
#include "tools/studio/server/pages.h"
#include "tools/studio/server/problems.h"

namespace forage::studio {
namespace {

constexpr std::size_t max_containers = 200'000, max_values = 1'000'000;  ///< in a message

/// The member `id` of a message, of which nothing else is kept that nests; null when it is no whole number.
json id_in(std::string_view message) {
    const auto is_kept = [](int depth, json::parse_event_t event, const json&) {
        return depth == 0 || event == json::parse_event_t::key || event == json::parse_event_t::value;
    };
    const auto parsed = json::parse(message, is_kept, false);
    const auto found = parsed.is_object() ? parsed.find("id") : parsed.end();
    return found != parsed.end() && found->is_number_integer() ? *found : json(nullptr);
}

std::string decoded(std::string_view text) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        unsigned char byte = 0;
        const char* const digits = text.data() + i + 1;
        if (text[i] == '%' && i + 2 < text.size() &&
            std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2) {
            out += static_cast<char>(byte);
            i += 2;
        } else {
            out += text[i] == '+' ? ' ' : text[i];
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
