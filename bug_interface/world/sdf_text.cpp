#include "bug_interface/world/sdf_text.h"

#include <algorithm>
#include <charconv>

namespace forage::bug {
namespace {

constexpr std::string_view mark = "forage://no-such-place/";
constexpr std::string_view blanks = " \t\r\n";

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(blanks);
    if (first == text.npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

bool are_numbers(std::string_view list) {
    while (!(list = trimmed(list)).empty()) {
        std::string_view word = list.substr(0, list.find_first_of(blanks));
        list.remove_prefix(word.size());
        if (word.starts_with('+')) word.remove_prefix(1);
        double value = 0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (error != std::errc{} || end != word.data() + word.size()) return false;
    }
    return true;
}

/// Calls `visit(name, from, to)` for every element of a well-formed text that begins with text of its own,
/// from the end of its start tag to the next '<'.
template <class F>
void each_content(std::string_view text, F visit) {
    for (std::size_t open = text.find('<'); open != text.npos; open = text.find('<', open)) {
        const auto skip = [&](std::string_view begin, std::string_view end) {
            if (!text.substr(open).starts_with(begin)) return false;
            const auto close = text.find(end, open + begin.size());
            open = close == text.npos ? text.size() : close + end.size();
            return true;
        };
        if (skip("<!--", "-->") || skip("<![CDATA[", "]]>") || skip("<!", ">") || skip("<?", "?>") ||
            skip("</", ">"))
            continue;
        const auto end_of_name = std::min(text.find_first_of(" \t\r\n/>", open), text.size());
        const std::string_view name = text.substr(open + 1, end_of_name - open - 1);
        // A '>' may stand in the value of an attribute.
        std::size_t close = end_of_name;
        for (char quote = 0; close < text.size() && (quote || text[close] != '>'); ++close)
            if (quote ? text[close] == quote : text[close] == '"' || text[close] == '\'')
                quote = quote ? '\0' : text[close];
        if (close >= text.size()) return;
        const auto next = std::min(text.find('<', close), text.size());
        if (text[close - 1] != '/' && !trimmed(text.substr(close + 1, next - close - 1)).empty())
            visit(name, close + 1, next);
        open = next;
    }
}

}  // namespace

std::string root_name(std::string_view text) {
    for (;;) {
        const auto open = text.find('<');
        if (open == std::string_view::npos) return {};
        text.remove_prefix(open + 1);
        if (!text.starts_with('!') && !text.starts_with('?'))
            return std::string(text.substr(0, text.find_first_of(" \t\r\n/>")));
        const std::string_view end = text.starts_with("!--") ? "-->" : ">";
        const auto close = text.find(end);
        if (close == std::string_view::npos) return {};
        text.remove_prefix(close + end.size());
    }
}

std::string with_marked_uris(std::string_view text) {
    std::string out;
    std::size_t copied = 0;
    each_content(text, [&](std::string_view name, std::size_t from, std::size_t) {
        if (name != "uri") return;
        const std::size_t at = text.find_first_not_of(blanks, from);
        out.append(text.substr(copied, at - copied)).append(mark);
        copied = at;
    });
    return out.append(text.substr(copied));
}

std::string without_mark(std::string uri) {
    if (uri.starts_with(mark)) uri.erase(0, mark.size());
    return uri;
}

void find_bad_numbers(std::string_view text, const std::function<bool(std::string_view)>& is_number,
                      const std::function<void(std::size_t, std::string_view)>& bad) {
    each_content(text, [&](std::string_view name, std::size_t from, std::size_t to) {
        if (!is_number(name) || are_numbers(text.substr(from, to - from))) return;
        const std::size_t at = text.find_first_not_of(blanks, from);
        bad(at, trimmed(text.substr(at, to - at)));
    });
}

}  // namespace forage::bug
