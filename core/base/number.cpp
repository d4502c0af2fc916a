#include "core/base/number.h"

#include <fmt/format.h>

#include "core/base/text_file.h"

namespace forage {

bool out_of_range(std::string_view word) {
    double value = 0;
    const char* const last = word.data() + word.size();
    const auto [end, error] = std::from_chars(word.data(), last, value);
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

}  // namespace forage
