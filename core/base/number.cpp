#include "core/base/number.h"

#include <fmt/format.h>

#include "core/base/text_file.h"

namespace forage {

bool out_of_range(std::string_view word) {
    double value = 0;
    const char* const last = word.data() + word.size();
    const auto [end, error] = from_chars(word.data(), last, value);
    return end == last && error == std::errc::result_out_of_range;
}

std::string no_number(std::string_view word) {
    if (word.empty()) return "there is no number here";
    if (out_of_range(word))
        return fmt::format("'{}' is beyond all numbers that can be stored", escaped(word));
    std::string_view rest = word;
    const bool infinite = take_number<double>(rest) && rest.empty();
    return fmt::format("'{}' is not a {}number", escaped(word), infinite ? "finite " : "");
}

std::string plain_number(double value, int digits) {
    const bool whole = std::abs(value) >= std::pow(10, digits - 1) && std::abs(value) < 1e15;
    return whole ? fmt::format("{:.0f}", value) : fmt::format("{:.{}g}", value, digits);
}

std::string rounded(double value, int decimals) {
    std::string out = fmt::format("{:.{}f}", value, decimals);
    if (out.find('.') != std::string::npos) {
        out.erase(out.find_last_not_of('0') + 1);
        if (out.ends_with('.')) out.pop_back();
    }
    return out == "-0" ? "0" : out;
}

std::string duration_text(double seconds) {
    constexpr double minute = 60, hour = 60 * minute, day = 24 * hour, year = 365 * day;
    if (seconds < 100) return fmt::format("{:.0f} s", seconds);
    if (seconds < 100 * minute) return fmt::format("{:.0f} min", seconds / minute);
    if (seconds < 2 * day) return fmt::format("{:.0f} hours", seconds / hour);
    if (seconds < 2 * year) return fmt::format("{:.0f} days", seconds / day);
    return fmt::format("{:.0f} years", seconds / year);
}

}  // namespace forage
