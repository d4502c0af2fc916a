// What a request may be: checks without sockets.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace forage::studio {

/// The reply to a message that is refused before it is parsed, as it nests too deeply or holds too much;
/// empty for other messages.
std::optional<std::string> refusal_of(std::string_view message);
/// A random secret of 32 hexadecimal digits.
std::string make_token();
/// The token in the first message of a page, `{"token": "..."}`; empty when it is another message.
std::string token_in(std::string_view message);
/// Whether a request with this Host and Origin (empty: none) may come from a page of this server, or from a
/// program that is no browser.
bool is_from_here(std::string_view host, std::string_view origin, std::uint16_t port);
/// The value of `name` in the query of a target such as "/picture?what=world&key=K", decoded; empty without
/// one.
std::string query_value(std::string_view target, std::string_view name);

}  // namespace forage::studio
