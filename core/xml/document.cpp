#include "core/xml/document.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <tinyxml2.h>

#include "core/base/number.h"
#include "core/xml/well_formed.h"

namespace forage::xml {
namespace {

constexpr std::string_view blanks = " \t\r\n";

void collect_comments(const Document& document, const tinyxml2::XMLNode& parent, std::vector<Comment>& out) {
    std::size_t waiting = out.size();  // comments that wait for the element before which they stand
    for (const auto* node = parent.FirstChild(); node; node = node->NextSibling()) {
        if (node->ToComment()) {
            const char* text = node->Value();
            out.push_back({text, {}, Element(parent.ToElement()), document.in_source(text)});
        }
        if (const auto* element = node->ToElement()) {
            for (; waiting < out.size(); ++waiting) out[waiting].before = Element(element);
            collect_comments(document, *element, out);
            waiting = out.size();
        }
    }
}

}  // namespace

std::vector<std::string_view> words(std::string_view list) {
    std::vector<std::string_view> out;
    constexpr std::size_t most = std::size_t{1} << 20;
    for (auto from = list.find_first_not_of(blanks); from != list.npos && out.size() < most;
         from = list.find_first_not_of(blanks, from)) {
        const auto to = std::min(list.find_first_of(blanks, from), list.size());
        out.push_back(list.substr(from, to - from));
        from = to;
    }
    return out;
}

// ---- values ----

std::optional<double> Value::number() const { return parse_number<double>(view); }

int Value::whole(int otherwise) const {
    const auto value = number();
    return value && std::abs(*value) <= std::numeric_limits<int>::max() ? static_cast<int>(*value)
                                                                        : otherwise;
}

std::optional<std::uint64_t> Value::count() const {
    const auto value = number();
    return value && *value >= 0 && *value <= 2e9 ? std::optional(static_cast<std::uint64_t>(*value))
                                                 : std::nullopt;
}

std::optional<bool> Value::flag() const {
    std::string lower(view.substr(0, 6));
    for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (lower == "true" || lower == "1") return true;
    if (lower == "false" || lower == "0") return false;
    return std::nullopt;
}

std::vector<double> Value::numbers() const {
    std::vector<double> out;
    for (const auto word : xml::words(view)) {
        const auto value = parse_number<double>(word);
        if (!value) break;
        out.push_back(*value);
    }
    return out;
}

Location Value::where() const { return at ? element.document().place(at) : element.where(); }

std::vector<Value> Value::words() const {
    std::vector<Value> out;
    const char *place = at, *passed = view.data();
    for (const auto word : xml::words(view)) {
        for (auto left = word.data() - std::exchange(passed, word.data()); left > 0 && *place; ++place)
            left -= *place != '\r';  // line ends of Windows are one character in `view`
        out.push_back({word, place, element});
    }
    return out;
}

// ---- elements ----

std::string_view Element::name() const { return xml_->Name(); }

const Document& Element::document() const {
    return *static_cast<const Document*>(xml_->GetDocument()->GetUserData());
}

Location Element::where() const { return document().place(document().in_source(xml_->Name()) - 1); }

Element Element::parent() const { return Element(xml_->Parent()->ToElement()); }

std::vector<Attribute> Element::attributes() const {
    const Document& d = document();
    std::vector<Attribute> out;
    for (const auto* a = xml_->FirstAttribute(); a; a = a->Next())
        out.push_back({a->Name(), d.in_source(a->Name()), {a->Value(), d.in_source(a->Value()), *this}});
    return out;
}

Value Element::operator[](std::string_view attribute) const {
    for (const auto* a = xml_->FirstAttribute(); a; a = a->Next())
        if (a->Name() == attribute) return {a->Value(), document().in_source(a->Value()), *this};
    return {{}, nullptr, *this};
}

std::vector<Element> Element::children(std::string_view wanted) const {
    std::vector<Element> out;
    for (const auto* e = xml_->FirstChildElement(); e; e = e->NextSiblingElement())
        if (wanted.empty() || e->Name() == wanted) out.emplace_back(e);
    return out;
}

Element Element::child(std::string_view path) const {
    const auto slash = std::min(path.find('/'), path.size());
    const Element found(xml_->FirstChildElement(std::string(path.substr(0, slash)).c_str()));
    return !found || slash == path.size() ? found : found.child(path.substr(slash + 1));
}

std::vector<Value> Element::texts() const {
    const Document& d = document();
    std::vector<Value> out;
    for (const auto* node = xml_->FirstChild(); node; node = node->NextSibling()) {
        if (!node->ToText()) continue;
        const std::string_view piece = node->Value();
        const auto first = piece.find_first_not_of(blanks);
        if (first == piece.npos) continue;
        // The piece is looked up in the original text, because tinyxml2 has shortened its copy after the
        // first line end.
        const char* at = d.in_source(piece.data());
        while (blanks.find(*at) != blanks.npos) ++at;
        out.push_back({piece.substr(first, piece.find_last_not_of(blanks) + 1 - first), at, *this});
    }
    return out;
}

std::string Element::text() const {
    std::string out;
    for (const auto* node = xml_->FirstChild(); node; node = node->NextSibling())
        if (node->ToText()) out += node->Value();
    return out.find_first_not_of(blanks) == out.npos ? std::string() : out;
}

Value Element::value(std::string_view path) const {
    const Element e = path.empty() ? *this : child(path);
    if (!e) return {{}, nullptr, *this};
    const auto all = e.texts();
    return all.empty() ? Value{{}, document().in_source(e.xml_->Name()) - 1, e} : all.front();
}

// ---- documents ----

std::unique_ptr<const Document> Document::parse(SourceFile file, std::string_view beginning,
                                                std::size_t max_nodes, Diagnostics& diagnostics) {
    auto document = std::make_unique<Document>();
    document->source = std::make_shared<SourceFile>(std::move(file));
    const std::string& t = document->source->text;
    document->line_starts = {0};
    for (std::size_t i = 0; i < t.size(); ++i)
        if (t[i] == '\n') document->line_starts.push_back(i + 1);
    const auto root = find_root(*document, beginning, max_nodes, diagnostics);
    if (!root) return nullptr;

    document->xml = std::make_shared<tinyxml2::XMLDocument>();
    auto& xml = *document->xml;
    if (xml.Parse(t.data(), t.size()) != tinyxml2::XML_SUCCESS || !xml.RootElement()) {
        diagnostics.error({document->source, std::max(xml.ErrorLineNum(), 0), 0},
                          fmt::format("not XML that can be read ({})", xml.ErrorName()));
        return nullptr;
    }
    xml.SetUserData(document.get());
    // tinyxml2 parses in place and hands out pointers into its copy of the text.
    document->buffer = xml.RootElement()->Name() - (root->data() - t.data());
    return document;
}

Element Document::root() const { return Element(xml->RootElement()); }

std::vector<Comment> Document::comments() const {
    std::vector<Comment> out;
    collect_comments(*this, *xml, out);
    return out;
}

std::vector<std::string> Document::instructions() const {
    std::vector<std::string> out;
    for (const auto* node = xml->FirstChild(); node; node = node->NextSibling())
        if (node->ToDeclaration() && !std::string_view(node->Value()).starts_with("xml "))
            out.emplace_back(node->Value());
    return out;
}

const char* Document::in_source(const char* in_buffer) const {
    const auto size = static_cast<std::ptrdiff_t>(source->text.size());
    return source->text.data() + std::clamp<std::ptrdiff_t>(in_buffer - buffer, 0, size);
}

Location Document::place(const char* at) const {
    const auto offset = static_cast<std::size_t>(at - source->text.data());
    const auto next = std::ranges::upper_bound(line_starts, offset);
    return {source, static_cast<int>(next - line_starts.begin()), static_cast<int>(offset - *(next - 1)) + 1};
}

}  // namespace forage::xml
