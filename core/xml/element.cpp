#include "core/xml/element.h"

#include <algorithm>

#include <tinyxml2.h>

#include "core/xml/document.h"

namespace forage::xml {
namespace {

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view blanks = " \t\r\n";
    const auto first = text.find_first_not_of(blanks);
    return first == text.npos ? std::string_view{}
                              : text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// Recurses as deep as elements are nested, which first_fault() limits.
Element copy(const Document& document, const tinyxml2::XMLElement& from) {
    Element out;
    out.name = from.Name(), out.where = document.at(from);
    for (const auto* a = from.FirstAttribute(); a; a = a->Next())
        out.attributes.push_back({a->Name(), a->Value(), document.value_of(*a)});
    for (const auto* node = from.FirstChild(); node; node = node->NextSibling()) {
        if (const auto* child = node->ToElement()) {
            out.children.push_back(copy(document, *child));
        } else if (const auto* text = node->ToText(); text && out.text.empty()) {
            out.text = trimmed(text->Value());
            if (!out.text.empty()) out.text_where = document.at(*text);
        }
    }
    return out;
}

}  // namespace

const Attribute* Element::attribute(std::string_view wanted) const {
    const auto found = std::find_if(attributes.begin(), attributes.end(),
                                    [&](const Attribute& a) { return a.name == wanted; });
    return found == attributes.end() ? nullptr : &*found;
}

const Element* Element::child(std::string_view path) const {
    const auto slash = std::min(path.find('/'), path.size());
    const auto found = std::find_if(children.begin(), children.end(),
                                    [&](const Element& e) { return e.name == path.substr(0, slash); });
    if (found == children.end()) return nullptr;
    return slash == path.size() ? &*found : found->child(path.substr(slash + 1));
}

std::optional<Element> parse_element(std::string path, std::string text, std::string_view beginning,
                                     std::size_t most_nodes, Diagnostics& diagnostics) {
    const auto document =
        Document::parse(std::move(path), std::move(text), beginning, diagnostics, most_nodes);
    if (!document) return std::nullopt;
    return copy(*document, document->root());
}

}  // namespace forage::xml
