#include "core/base/text_difference.h"

#include <fmt/format.h>

#include "core/base/alignment.h"

namespace forage {
namespace {

std::vector<std::string_view> lines(std::string_view text) {
    std::vector<std::string_view> out;
    while (!text.empty()) {
        const auto end = std::min(text.find('\n'), text.size() - 1) + 1;
        out.push_back(text.substr(0, end));
        text.remove_prefix(end);
    }
    return out;
}

/// The range of lines of a part: where it begins, from 1, and how many there are.
std::string range(int begin, int count) {
    const int first = count == 0 ? begin : begin + 1;
    return count == 1 ? fmt::format("{}", first) : fmt::format("{},{}", first, count);
}

}  // namespace

std::string unified_difference(std::string_view before, std::string_view after, std::string_view name_before,
                               std::string_view name_after) {
    if (before == after) return {};
    constexpr std::size_t around = 3;
    const auto a = lines(before), b = lines(after);
    const auto pairs = aligned(a, b);
    const auto changed = [&](std::size_t k) { return pairs[k].first < 0 || pairs[k].second < 0; };
    std::string out = fmt::format("--- {}\n+++ {}\n", name_before, name_after);
    int done_a = 0, done_b = 0;  // lines before the pair `at`
    std::size_t at = 0;
    const auto pass = [&](std::size_t to) {
        for (; at < to; ++at) done_a += pairs[at].first >= 0, done_b += pairs[at].second >= 0;
    };
    for (std::size_t k = 0; k < pairs.size();) {
        if (!changed(k)) {
            ++k;
            continue;
        }
        std::size_t last = k;  // the last change of this part
        for (std::size_t i = k; i < pairs.size() && i <= last + 2 * around; ++i)
            if (changed(i)) last = i;
        const std::size_t begin = std::max(k, at + around) - around;
        const std::size_t end = std::min(last + 1 + around, pairs.size());
        pass(begin);
        const int from_a = done_a, from_b = done_b;
        std::string part;
        const auto line = [&](char sign, std::string_view text) {
            part += sign;
            part += text;
            if (!text.ends_with('\n')) part += "\n\\ No newline at end of file\n";
        };
        for (std::size_t i = begin; i < end; ++i) {
            const auto [x, y] = pairs[i];
            if (x >= 0) line(y >= 0 ? ' ' : '-', a[static_cast<std::size_t>(x)]);
            if (x < 0) line('+', b[static_cast<std::size_t>(y)]);
        }
        pass(end);
        out +=
            fmt::format("@@ -{} +{} @@\n", range(from_a, done_a - from_a), range(from_b, done_b - from_b)) +
            part;
        k = end;
    }
    return out;
}

}  // namespace forage
