#include "core/xml/document.h"

#include <fmt/format.h>
#include <tinyxml2.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace forage::xml {
namespace {

constexpr std::size_t largest_file = std::size_t{256} << 20;

/// Where tinyxml2's copy of the text begins. It parses in place and hands out pointers into that copy, so the
/// offset of anything it names is a difference of pointers. The first thing in a document begins at the first '<'.
const char* buffer_start(const tinyxml2::XMLDocument& xml, const std::string& text) {
    const tinyxml2::XMLNode* first = xml.FirstChild();
    const auto open = text.find('<');
    if (!first || open == std::string::npos) return nullptr;
    std::size_t prefix = 1;                                    // "<" of an element
    if (first->ToDeclaration()) prefix = 2;                    // "<?"
    else if (first->ToComment()) prefix = 4;                   // "<!--"
    else if (first->ToUnknown()) prefix = 2;                   // "<!"
    else if (first->ToText()) return nullptr;
    return first->Value() - prefix - open;
}

std::string hint_for(const tinyxml2::XMLDocument& xml) {
    switch (xml.ErrorID()) {
        case tinyxml2::XML_ERROR_MISMATCHED_ELEMENT: return "an element is closed by another's end tag: every <Name> needs its </Name>";
        case tinyxml2::XML_ERROR_PARSING_ATTRIBUTE: return "attributes are written name=\"value\", with a blank between them";
        case tinyxml2::XML_ERROR_EMPTY_DOCUMENT: return "the file holds no element";
        case tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED: return "elements are nested too deeply";
        case tinyxml2::XML_ERROR_PARSING_ELEMENT: return "a '<' or '&' in a text is written &lt; or &amp;";
        default: return {};
    }
}

}  // namespace

Document::Document() : xml_(std::make_unique<tinyxml2::XMLDocument>()) {}
Document::Document(Document&&) noexcept = default;
Document& Document::operator=(Document&&) noexcept = default;
Document::~Document() = default;

std::optional<Document> Document::read(const std::string& path, Diagnostics& diagnostics) {
    const auto fail = [&](const std::string& message, const std::string& hint = {}) -> std::optional<Document> {
        auto file = std::make_shared<SourceFile>(SourceFile{path, {}});
        diagnostics.error({file, 0, 0}, message, hint);
        return std::nullopt;
    };
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) {
        std::vector<std::string> siblings;
        const auto folder = std::filesystem::path(path).parent_path();
        for (const auto& entry : std::filesystem::directory_iterator(folder.empty() ? "." : folder, error))
            if (entry.path().extension() == std::filesystem::path(path).extension())
                siblings.push_back((folder / entry.path().filename()).string());
        std::sort(siblings.begin(), siblings.end());
        return fail("there is no such file", suggest(path, siblings));
    }
    if (std::filesystem::is_directory(status)) return fail("this is a directory, not a file");
    if (const auto size = std::filesystem::file_size(path, error); !error && size > largest_file)
        return fail(fmt::format("the file is larger than {} MiB", largest_file >> 20));
    std::ifstream in(path, std::ios::binary);
    std::ostringstream text;
    if (!in || !(text << in.rdbuf())) {
        if (!in.is_open()) return fail(fmt::format("cannot read the file: {}", std::strerror(errno)));
        if (in.peek() != std::ifstream::traits_type::eof()) return fail("cannot read the file");
    }
    return parse(path, std::move(text).str(), diagnostics);
}

std::optional<Document> Document::parse(std::string path, std::string text, Diagnostics& diagnostics) {
    Document document;
    document.source_ = std::make_shared<SourceFile>(SourceFile{std::move(path), std::move(text)});
    const std::string& t = document.source_->text;
    document.line_starts_ = {0};
    for (std::size_t i = 0; i < t.size(); ++i)
        if (t[i] == '\n') document.line_starts_.push_back(i + 1);

    auto& xml = *document.xml_;
    if (xml.Parse(t.data(), t.size()) != tinyxml2::XML_SUCCESS) {
        const int line = xml.ErrorLineNum();
        const std::string name = tinyxml2::XMLDocument::ErrorIDToName(xml.ErrorID());
        std::string what = "not well-formed XML";
        if (xml.ErrorID() == tinyxml2::XML_ERROR_MISMATCHED_ELEMENT) what += ": an end tag does not match its element";
        else if (xml.ErrorID() == tinyxml2::XML_ERROR_PARSING_ATTRIBUTE) what += ": a damaged attribute";
        else if (xml.ErrorID() == tinyxml2::XML_ERROR_EMPTY_DOCUMENT) what = "the file is empty";
        else if (xml.ErrorID() == tinyxml2::XML_ERROR_PARSING) what += ": the text ends too early or is damaged";
        else what += fmt::format(" ({})", name);
        int column = 0;
        if (line > 0 && static_cast<std::size_t>(line) <= document.line_starts_.size()) {
            const auto start = document.line_starts_[static_cast<std::size_t>(line - 1)];
            column = static_cast<int>(std::min(t.find_first_not_of(" \t", start), t.size()) - start) + 1;
        }
        diagnostics.error({document.source_, line, column}, what, hint_for(xml));
        return std::nullopt;
    }
    if (!xml.RootElement()) {
        diagnostics.error({document.source_, 0, 0}, "the file holds no element");
        return std::nullopt;
    }
    document.buffer_ = buffer_start(xml, t);
    return document;
}

const tinyxml2::XMLElement& Document::root() const { return *xml_->RootElement(); }

Location Document::locate(const char* in_buffer, int fallback_line, int shift) const {
    const std::ptrdiff_t offset = in_buffer - buffer_ + shift;
    if (!buffer_ || offset < 0 || offset >= static_cast<std::ptrdiff_t>(source_->text.size())) return {source_, fallback_line, 0};
    const auto next = std::upper_bound(line_starts_.begin(), line_starts_.end(), static_cast<std::size_t>(offset));
    const auto line = next - line_starts_.begin();
    return {source_, static_cast<int>(line), static_cast<int>(offset - static_cast<std::ptrdiff_t>(*(next - 1))) + 1};
}

Location Document::at(const tinyxml2::XMLElement& element) const { return locate(element.Name(), element.GetLineNum(), -1); }
Location Document::name_of(const tinyxml2::XMLAttribute& a) const { return locate(a.Name(), a.GetLineNum(), 0); }
Location Document::value_of(const tinyxml2::XMLAttribute& a) const { return locate(a.Value(), a.GetLineNum(), 0); }

}  // namespace forage::xml
