// An XML file whose elements and attributes know their line and column.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/diagnostic.h"

namespace tinyxml2 {
class XMLDocument;
class XMLElement;
class XMLAttribute;
class XMLText;
}  // namespace tinyxml2

namespace forage::xml {

class Document {
  public:
    /// Reads `path`; on failure reports what and where, and returns nothing. `beginning`: how the outermost
    /// element of such a file begins, for hints ("<System ...>").
    static std::optional<Document> read(const std::string& path, std::string_view beginning,
                                        Diagnostics& diagnostics);
    /// Parses `text`, which a person knows as `path`; at most `most_nodes` elements and attributes.
    static std::optional<Document> parse(std::string path, std::string text, std::string_view beginning,
                                         Diagnostics& diagnostics,
                                         std::size_t most_nodes = std::size_t{1} << 20);

    Document(Document&&) noexcept;
    Document& operator=(Document&&) noexcept;
    ~Document();

    const tinyxml2::XMLElement& root() const;
    const std::shared_ptr<const SourceFile>& source() const { return source_; }

    Location at(const tinyxml2::XMLElement& element) const;  ///< of the '<'
    Location at(const tinyxml2::XMLText& text) const;        ///< of the first character that is no blank
    Location name_of(const tinyxml2::XMLAttribute& attribute) const;   ///< of the attribute's name
    Location value_of(const tinyxml2::XMLAttribute& attribute) const;  ///< of the value's first character

  private:
    Document();
    Location place(std::size_t offset) const;  ///< of a byte of the text
    Location locate(const char* in_buffer, int fallback_line, int shift) const;

    std::unique_ptr<tinyxml2::XMLDocument> xml_;
    std::shared_ptr<const SourceFile> source_;
    std::vector<std::size_t> line_starts_;
    const char* buffer_ = nullptr;  ///< where tinyxml2 keeps its copy of the text
};

}  // namespace forage::xml
