// The text of an XML file as a tree of places: what stands where, byte by byte.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace forage::xml {

/// The bytes from `begin` up to, but without, `end`.
struct Span {
    std::size_t begin = 0, end = 0;
    std::string_view of(std::string_view text) const { return text.substr(begin, end - begin); }
    friend bool operator==(const Span&, const Span&) = default;
};

struct SourceAttribute {
    std::string_view name;   ///< a part of the text
    std::string_view value;  ///< as written, between the quotes
    Span whole;              ///< from the name to the closing quote
    Span inside;             ///< the value
};

/// An element with its places in the text. Names and values are parts of the text, which must outlive it. A
/// part of the diagram in a comment (canvas.h) is an element, too: its tag is the comment.
struct SourceElement {
    std::string_view name;
    Span whole;          ///< from '<' of the start tag to '>' of the end tag
    Span tag;            ///< the start tag with '<' and '>'
    Span content;        ///< between the tags; empty at the end of the tag when there is no end tag
    bool closed = true;  ///< whether there is an end tag: `<a></a>`, not `<a/>`
    std::vector<SourceAttribute> attributes;
    std::vector<SourceElement> children;
    std::vector<Span> comments;  ///< directly in the element, without those that are elements

    const SourceAttribute* attribute(std::string_view name) const;
    /// The value of an attribute as written; empty when it is absent.
    std::string_view value(std::string_view name) const;
};

/// The outermost element of a text that is well-formed, as Document::parse() has found.
SourceElement scan(std::string_view text);

/// The blanks before `at` on its line when nothing else stands there.
struct LineStart {
    bool alone = false;  ///< whether only blanks stand before `at` on its line
    std::size_t begin = 0;
    std::string_view indentation;
};
LineStart line_start(std::string_view text, std::size_t at);

/// `text` as the content of an element or as a value between double quotes, in XML and HTML.
std::string encoded(std::string_view text);

/// Replacements of parts of a text, which do not overlap.
class TextEdits {
  public:
    void replace(Span span, std::string text) { edits_.emplace_back(span, std::move(text)); }
    void insert(std::size_t at, std::string text) { replace({at, at}, std::move(text)); }
    /// Cuts what stands there, with its lines when nothing else stands on them.
    void cut(std::string_view text, Span span);
    bool empty() const { return edits_.empty(); }
    /// The text with all replacements. Insertions at the same place stand in the order in which they were
    /// made.
    std::string applied(std::string_view text) const;

  private:
    std::vector<std::pair<Span, std::string>> edits_;
};

/// How a file is laid out.
struct Layout {
    std::string newline = "\n";  ///< the first line end of the file
    std::string unit = "    ";   ///< the blanks by which an element is indented in another one
};
Layout layout_of(std::string_view text, const SourceElement& root);

/// An element of `text` laid out again at the indentation `indentation`. The first line is not indented. With
/// an empty newline, everything stands on one line.
std::string rendered(std::string_view text, const SourceElement& element, std::string_view indentation,
                     const Layout& layout);

/// An element of another text, with the comments before it.
struct Piece {
    std::string_view text;
    const SourceElement* element;
    std::vector<Span> comments = {};
};
/// Inserts elements into `parent`, after its child `after`, or at its beginning when that is null. They are
/// laid out like their neighbours.
void insert_into(TextEdits& edits, std::string_view text, const SourceElement& parent,
                 const SourceElement* after, const Layout& layout, const std::vector<Piece>& pieces);

}  // namespace forage::xml
