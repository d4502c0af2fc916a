#include "tools/api/text_parts.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/base/alignment.h"
#include "core/run/input_error.h"

namespace forage::editing {
namespace {

using Pieces = std::vector<std::string_view>;

/// The lines of a text, each with its end; the tags of a long line are apart.
Pieces pieces(std::string_view text) {
    constexpr std::size_t long_line = 200;
    Pieces out;
    while (!text.empty()) {
        auto size = std::min(text.find('\n'), text.size() - 1) + 1;
        if (size > long_line) size = std::min(text.find('>'), size - 1) + 1;
        out.push_back(text.substr(0, size));
        text.remove_prefix(size);
    }
    return out;
}

std::string joined(Pieces::const_iterator begin, Pieces::const_iterator end) {
    std::string out;
    for (; begin != end; ++begin) out += *begin;
    return out;
}

enum class Times { none, once, several };

Times times(std::string_view text, std::string_view part) {
    const auto first = part.empty() ? text.npos : text.find(part);
    if (first == text.npos) return Times::none;
    return text.find(part, first + 1) == text.npos ? Times::once : Times::several;
}

}  // namespace

nlohmann::json replace_operation(const std::string& before, const std::string& after) {
    const Pieces a = pieces(before), b = pieces(after);
    const auto pairs = aligned(a, b);
    const auto differs = [&](std::size_t k) { return pairs[k].first < 0 || pairs[k].second < 0; };
    nlohmann::json parts = nlohmann::json::array();
    std::string text = before;  // as the parts until now have made it
    auto left = a.begin();      // what is still as before
    auto made = b.begin();      // what is as after
    std::size_t made_size = 0;  // bytes of the text until there
    for (std::size_t k = 0; k < pairs.size();) {
        if (!differs(k)) {
            made_size += left->size(), ++left, ++made, ++k;
            continue;
        }
        auto left_end = left, made_end = made;
        for (; k < pairs.size() && differs(k); ++k) pairs[k].first < 0 ? ++made_end : ++left_end;
        const auto core = joined(left, left_end), core_after = joined(made, made_end);
        std::string old = core, front, back;
        for (std::ptrdiff_t around = 1; times(text, old) != Times::once && old.size() < text.size();
             around *= 2) {
            front = joined(made - std::min(around, made - b.begin()), made);
            back = joined(left_end, left_end + std::min(around, a.end() - left_end));
            old = front + core + back;
        }
        parts.push_back({{"old", old}, {"new", front + core_after + back}});
        text.replace(made_size, core.size(), core_after);
        made_size += core_after.size(), left = left_end, made = made_end;
    }
    return {{"do", "replace"}, {"parts", std::move(parts)}};
}

std::string with_parts_replaced(std::string text, const nlohmann::json& operation) {
    const auto& parts = operation.at("parts");
    if (!parts.is_array())
        throw InputError("'parts' is a list",
                         R"({"do": "replace", "parts": [{"old": "...", "new": "..."}]})");
    std::size_t number = 0;
    for (const auto& part : parts) {
        ++number;
        const auto old = part.at("old").get<std::string>();
        switch (times(text, old)) {
            case Times::none:
                throw InputError(fmt::format("'old' of part {} is not in the text", number),
                                 "it is there to the last blank and line break");
            case Times::several:
                throw InputError(fmt::format("'old' of part {} is in the text several times", number),
                                 "take more of what is around it");
            case Times::once:
                text.replace(text.find(old), old.size(), part.at("new").get<std::string>());
        }
    }
    return text;
}

}  // namespace forage::editing
