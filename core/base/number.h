// Numbers in texts: one notation for files, options and expressions.
#pragma once

#include <charconv>
#include <cmath>
#include <concepts>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

#ifndef __cpp_lib_to_chars  // libc++ reads no floating-point numbers
#include <fast_float/fast_float.h>
#endif

namespace forage {

#ifdef __cpp_lib_to_chars
using std::from_chars;
#else
inline auto from_chars(const char* first, const char* last, double& value) {
    return fast_float::from_chars(first, last, value);
}
template <std::integral N>
auto from_chars(const char* first, const char* last, N& value) {
    return std::from_chars(first, last, value);
}
#endif

/// Removes the number at the front of `text` and returns it. Numbers are in C notation, whatever the locale,
/// with or without a sign; `nan` and `inf` are numbers, too. Returns nothing and leaves `text` unchanged when
/// `text` does not begin with a number or when N cannot hold it.
template <class N>
std::optional<N> take_number(std::string_view& text) {
    N value{};
    const std::size_t sign = text.starts_with('+') && !text.starts_with("+-") ? 1 : 0;
    const auto [end, error] = from_chars(text.data() + sign, text.data() + text.size(), value);
    if (error != std::errc{}) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return value;
}

/// The whole `text` as a finite number. Empty when it is not one.
template <class N>
std::optional<N> parse_number(std::string_view text) {
    const auto value = take_number<N>(text);
    if (!value || !text.empty()) return std::nullopt;
    if constexpr (std::is_floating_point_v<N>)
        if (!std::isfinite(*value)) return std::nullopt;
    return value;
}

/// Whether `word` is a number that is too large, or too close to 0, for a double.
bool out_of_range(std::string_view word);

/// The message for a word that is not a finite number where one is expected.
std::string no_number(std::string_view word);

/// The number for readers, with this many significant digits or, when it is larger, as a whole number: no
/// exponent (but from 1e15 on, and below 0.0001).
std::string plain_number(double value, int digits);

/// The number with at most this many decimals, without zeros at its end.
std::string rounded(double value, int decimals = 4);

/// A length of time in words, rounded to one unit: "42 s", "7 min", "3 hours", "12 days", "5 years".
std::string duration_text(double seconds);

}  // namespace forage
