#include "core/xml/document.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <tinyxml2.h>

#include "core/base/named_file.h"
#include "core/xml/well_formed.h"

namespace forage::xml {
namespace {

constexpr std::size_t largest_file = std::size_t{32} << 20;

/// Where tinyxml2's copy of the text begins. It parses in place and hands out pointers into that copy, so the
/// offset of anything it names is a difference of pointers. The first thing in a document begins at the first
/// '<'.
const char* buffer_start(const tinyxml2::XMLDocument& xml, const std::string& text) {
    const tinyxml2::XMLNode* first = xml.FirstChild();
    const auto open = text.find('<');
    if (!first || open == std::string::npos) return nullptr;
    std::size_t prefix = 1;  // "<" of an element
    if (first->ToDeclaration())
        prefix = 2;  // "<?"
    else if (first->ToComment())
        prefix = 4;  // "<!--"
    else if (first->ToUnknown())
        prefix = 2;  // "<!"
    else if (first->ToText())
        return nullptr;
    return first->Value() - prefix - open;
}

}  // namespace

Document::Document() : xml_(std::make_unique<tinyxml2::XMLDocument>()) {}
Document::Document(Document&&) noexcept = default;
Document& Document::operator=(Document&&) noexcept = default;
Document::~Document() = default;

std::optional<Document> Document::read(const std::string& path, std::string_view beginning,
                                       Diagnostics& diagnostics) {
    auto text = read_file(path, largest_file, diagnostics);
    if (!text) return std::nullopt;
    return parse(path, std::move(*text), beginning, diagnostics);
}

std::optional<Document> Document::parse(std::string path, std::string text, std::string_view beginning,
                                        Diagnostics& diagnostics, std::size_t most_nodes) {
    Document document;
    document.source_ = std::make_shared<SourceFile>(SourceFile{std::move(path), std::move(text)});
    const std::string& t = document.source_->text;
    document.line_starts_ = {0};
    for (std::size_t i = 0; i < t.size(); ++i)
        if (t[i] == '\n') document.line_starts_.push_back(i + 1);

    if (const auto fault = first_fault(t, beginning, most_nodes)) {
        const Location where =
            fault->of_the_whole ? Location{document.source_, 0, 0} : document.place(fault->offset);
        diagnostics.error(where, fault->message, fault->hint);
        return std::nullopt;
    }
    auto& xml = *document.xml_;
    if (xml.Parse(t.data(), t.size()) != tinyxml2::XML_SUCCESS || !xml.RootElement()) {
        diagnostics.error({document.source_, std::max(xml.ErrorLineNum(), 0), 0},
                          fmt::format("not XML that can be read ({})",
                                      tinyxml2::XMLDocument::ErrorIDToName(xml.ErrorID())));
        return std::nullopt;
    }
    document.buffer_ = buffer_start(xml, t);
    return document;
}

const tinyxml2::XMLElement& Document::root() const { return *xml_->RootElement(); }

Location Document::place(std::size_t offset) const {
    const auto next = std::upper_bound(line_starts_.begin(), line_starts_.end(), offset);
    return {source_, static_cast<int>(next - line_starts_.begin()),
            static_cast<int>(offset - *(next - 1)) + 1};
}

Location Document::locate(const char* in_buffer, int fallback_line, int shift) const {
    const std::ptrdiff_t offset = in_buffer - buffer_ + shift;
    if (!buffer_ || offset < 0 || offset >= static_cast<std::ptrdiff_t>(source_->text.size()))
        return {source_, fallback_line, 0};
    return place(static_cast<std::size_t>(offset));
}

Location Document::at(const tinyxml2::XMLElement& element) const {
    return locate(element.Name(), element.GetLineNum(), -1);
}
Location Document::at(const tinyxml2::XMLText& text) const {
    const std::ptrdiff_t offset = text.Value() - buffer_;
    if (!buffer_ || offset < 0) return {source_, text.GetLineNum(), 0};
    // Looked up in the text as it was read: tinyxml2 has shortened its copy of what follows the first line
    // end.
    return place(std::min(source_->text.find_first_not_of(" \t\r\n", static_cast<std::size_t>(offset)),
                          source_->text.size()));
}
Location Document::name_of(const tinyxml2::XMLAttribute& a) const {
    return locate(a.Name(), a.GetLineNum(), 0);
}
Location Document::value_of(const tinyxml2::XMLAttribute& a) const {
    return locate(a.Value(), a.GetLineNum(), 0);
}

}  // namespace forage::xml
