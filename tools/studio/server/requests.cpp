// What a request may be: checks without sockets.
#include <random>

#include <fmt/format.h>

#include "tools/studio/server/http_server.h"

namespace forage::studio {
namespace {

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

std::string cookie_value(std::string_view header, std::string_view name) {
    while (!header.empty()) {
        while (header.starts_with(' ')) header.remove_prefix(1);
        const auto end = std::min(header.find(';'), header.size());
        const std::string_view pair = header.substr(0, end);
        if (pair.size() > name.size() && pair.starts_with(name) && pair[name.size()] == '=')
            return std::string(pair.substr(name.size() + 1));
        header.remove_prefix(std::min(end + 1, header.size()));
    }
    return {};
}

}  // namespace forage::studio
