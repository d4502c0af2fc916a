#include "core/xml/source_tree.h"

#include <algorithm>

#include "core/base/sequence.h"

namespace forage::xml {
namespace {

constexpr std::string_view spaces = " \t\r\n";

/// The end of the line of `at` when only blanks stand between them, after its line end; otherwise npos.
std::size_t line_end(std::string_view text, std::size_t at) {
    const auto end = text.find_first_not_of(" \t\r", at);
    if (end == text.npos) return text.size();
    return text[end] == '\n' ? end + 1 : text.npos;
}

}  // namespace

const SourceAttribute* SourceElement::attribute(std::string_view wanted) const {
    return find_by(attributes, wanted, &SourceAttribute::name);
}

std::string_view SourceElement::value(std::string_view wanted) const {
    const auto* found = attribute(wanted);
    return found ? found->value : std::string_view();
}

LineStart line_start(std::string_view text, std::size_t at) {
    const auto before = text.substr(0, at).find_last_not_of(" \t");
    if (before != text.npos && text[before] != '\n') return {};
    const std::size_t begin = before == text.npos ? 0 : before + 1;
    return {true, begin, text.substr(begin, at - begin)};
}

void TextEdits::cut(std::string_view text, Span span) {
    const auto start = line_start(text, span.begin);
    const auto end = line_end(text, span.end);
    if (start.alone && end != text.npos) span = {start.begin, end};
    replace(span, {});
}

std::string TextEdits::applied(std::string_view text) const {
    auto edits = edits_;
    std::ranges::stable_sort(edits, {}, [](const auto& e) { return e.first.begin; });
    std::string out;
    std::size_t done = 0;
    for (const auto& [span, replacement] : edits) {
        if (span.begin > done) out += text.substr(done, span.begin - done);
        out += replacement;
        done = std::max(done, span.end);
    }
    return out += text.substr(std::min(done, text.size()));
}

Layout layout_of(std::string_view text, const SourceElement& root) {
    Layout out;
    if (const auto line = text.find('\n'); line != text.npos && line > 0 && text[line - 1] == '\r')
        out.newline = "\r\n";
    const auto outer = line_start(text, root.whole.begin);
    for (const auto& child : root.children)
        if (const auto inner = line_start(text, child.whole.begin);
            inner.alone && inner.indentation.starts_with(outer.indentation)) {
            out.unit = inner.indentation.substr(outer.indentation.size());
            break;
        }
    return out;
}

std::string rendered(std::string_view text, const SourceElement& e, std::string_view indentation,
                     const Layout& layout) {
    if (e.children.empty() && e.comments.empty()) return std::string(e.whole.of(text));
    std::string out(e.tag.of(text));
    const std::string inner =
        layout.newline.empty() ? std::string() : layout.newline + std::string(indentation) + layout.unit;
    auto comment = e.comments.begin();
    const auto comments_before = [&](std::size_t at) {
        for (; comment != e.comments.end() && comment->begin < at; ++comment)
            out += inner + std::string(comment->of(text));
    };
    for (const auto& child : e.children) {
        comments_before(child.whole.begin);
        out += inner + rendered(text, child, std::string(indentation) + layout.unit, layout);
    }
    comments_before(e.whole.end);
    if (!layout.newline.empty()) out += layout.newline + std::string(indentation);
    return out + "</" + std::string(e.name) + ">";
}

void insert_into(TextEdits& edits, std::string_view text, const SourceElement& parent,
                 const SourceElement* after, const Layout& layout, const std::vector<Piece>& pieces) {
    const auto lines = [&](std::string_view indentation, const Layout& style) {
        const std::string begin = style.newline + std::string(style.newline.empty() ? "" : indentation);
        std::string out;
        for (const auto& [from, piece, comments] : pieces) {
            for (const Span& c : comments) out += begin + std::string(c.of(from));
            out += begin + rendered(from, *piece, indentation, style);
        }
        return out;
    };
    const Layout one_line{"", ""};
    if (after) {
        const auto start = line_start(text, after->whole.begin);
        edits.insert(after->whole.end, lines(start.indentation, start.alone ? layout : one_line));
        return;
    }
    const auto start = line_start(text, parent.whole.begin);
    const bool empty = parent.content.of(text).find_first_not_of(spaces) == std::string_view::npos;
    if (empty) {
        const std::string outer = start.alone ? layout.newline + std::string(start.indentation) : "";
        const std::string inner =
            start.alone ? lines(std::string(start.indentation) + layout.unit, layout) : lines({}, one_line);
        if (parent.closed)
            edits.replace(parent.content, inner + outer);
        else
            edits.replace({text.find_last_not_of(" \t\r\n", parent.tag.end - 3) + 1, parent.whole.end},
                          ">" + inner + outer + "</" + std::string(parent.name) + ">");
        return;
    }
    if (parent.children.empty()) {
        edits.insert(parent.content.begin, lines(std::string(start.indentation) + layout.unit, layout));
        return;
    }
    const auto inner = line_start(text, parent.children.front().whole.begin);
    edits.insert(parent.content.begin, lines(inner.indentation, inner.alone ? layout : one_line));
}

std::string encoded(std::string_view text) {
    std::string out;
    for (const char c : text)
        if (c == '&')
            out += "&amp;";
        else if (c == '<')
            out += "&lt;";
        else if (c == '"')
            out += "&quot;";
        else
            out += c;
    return out;
}

}  // namespace forage::xml
