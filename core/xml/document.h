// An XML file as a tree of elements, each with its location in the file.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/diagnostic.h"

namespace tinyxml2 {
class XMLDocument;
class XMLElement;
}  // namespace tinyxml2

namespace forage::xml {

struct Attribute;
struct Document;
struct Value;

/// A handle of an element, which the document owns. It is false when there is no such element.
class Element {
  public:
    Element() = default;
    explicit Element(const tinyxml2::XMLElement* xml) : xml_(xml) {}

    explicit operator bool() const { return xml_ != nullptr; }
    auto operator<=>(const Element&) const = default;

    std::string_view name() const;
    Location where() const;  ///< the location of the '<'
    Element parent() const;  ///< false for the outermost element
    const Document& document() const;

    std::vector<Attribute> attributes() const;
    /// The value of an attribute.
    Value operator[](std::string_view attribute) const;

    /// The elements directly in this one, in file order; only those with this name if it is given.
    std::vector<Element> children(std::string_view name = {}) const;
    /// The first element to which a path of names leads ("inertia/izz").
    Element child(std::string_view path) const;

    /// The pieces of text directly in the element, without the blanks around them. Comments, elements and
    /// CDATA sections divide a text into pieces. Pieces of blanks are left out.
    std::vector<Value> texts() const;
    /// All text directly in the element, with its blanks; empty when there are only blanks.
    std::string text() const;
    /// The first piece of text in the element to which `path` leads, in this element when the path is empty.
    /// It is present, though empty, in an element without text.
    Value value(std::string_view path = {}) const;

  private:
    const tinyxml2::XMLElement* xml_ = nullptr;
};

/// The value of an attribute, or a text. It is false when the file has no such attribute or element. When the
/// value is absent or of another kind, a getter returns nothing or `otherwise`, and check() reports it.
struct Value {
    std::string_view view;     ///< empty when absent
    const char* at = nullptr;  ///< first character in the file's text; null when absent
    Element element;           ///< the element that has it, or should have it

    explicit operator bool() const { return at != nullptr; }
    std::string text() const { return std::string(view); }
    std::optional<double> number() const;
    double number(double otherwise) const { return number().value_or(otherwise); }
    /// The number without its fraction; `otherwise` also for a number that does not fit into an int.
    int whole(int otherwise) const;
    /// The number without its fraction, when it is from 0 to 2e9.
    std::optional<std::uint64_t> count() const;
    /// The value of true, false, 1 or 0, in upper or lower case.
    std::optional<bool> flag() const;
    bool flag(bool otherwise) const { return flag().value_or(otherwise); }
    /// The words of a list with blanks between them, each with its location.
    std::vector<Value> words() const;
    /// The numbers of a list with blanks between them, up to the first word that is not a number.
    std::vector<double> numbers() const;

    /// The location of the first character; that of the element when the value is absent.
    Location where() const;
};

struct Attribute {
    std::string_view name;
    const char* at;  ///< first character of the name in the file's text
    Value value;
};

/// A comment in the element `parent`. It stands before the element `before`, which is false for a comment at
/// the end of `parent`.
struct Comment {
    std::string_view text;
    Element before, parent;
    const char* at = nullptr;  ///< its first character in the file's text, after `<!--`
};

/// A file that is well-formed XML. It must not be moved, as elements point to it.
struct Document {
    std::shared_ptr<const SourceFile> source;
    std::vector<std::size_t> line_starts;  ///< offset of the first byte of each line
    std::shared_ptr<tinyxml2::XMLDocument> xml;
    const char* buffer = nullptr;  ///< where tinyxml2 keeps its copy of the text

    /// Parses the text of a file: XML 1.0 in UTF-8, without entities of its own, with elements nested at most
    /// 64 deep. Reports the first fault, if there is one, and returns null then.
    /// `beginning` is the start tag of such a file, for hints ("<System ...>"); `max_nodes` limits its
    /// elements, attributes and comments.
    static std::unique_ptr<const Document> parse(SourceFile file, std::string_view beginning,
                                                 std::size_t max_nodes, Diagnostics& diagnostics);

    Element root() const;
    std::vector<Comment> comments() const;          ///< in file order
    std::vector<std::string> instructions() const;  ///< processing instructions, without the XML declaration

    /// The position in the file's text that corresponds to a position in tinyxml2's copy.
    const char* in_source(const char* in_buffer) const;
    /// The location of a character of the file's text.
    Location place(const char* at) const;
};

/// The words of a list with blanks between them, at most 1,048,576. A longer list is wrong in every place.
std::vector<std::string_view> words(std::string_view list);

}  // namespace forage::xml
