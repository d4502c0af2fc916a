#include "core/xml/rules.h"

#include <algorithm>

#include "core/base/sequence.h"
#include "core/xml/document.h"

namespace forage::xml {

const AttributeRule* ElementRule::attribute(std::string_view wanted) const {
    return find_by(attributes, wanted, &AttributeRule::name);
}

const ElementRule* Format::find(std::string_view element) const {
    return find_by(elements, element, &ElementRule::name);
}

Format&& Format::link() && {
    static const ElementRule nothing_inside;
    std::map<std::string_view, ElementRule*> index;
    for (ElementRule& e : elements) index[e.name] = &e;
    for (ElementRule& e : elements)
        for (std::string_view word : words(e.content)) {
            std::optional<std::string> inert;
            if (const auto at = word.find('='); at < word.size())
                inert = word.substr(at + 1), word = word.substr(0, at);
            const auto colon = std::min(word.find(':'), word.size());
            const ValueRule* value =
                colon < word.size() ? &values.at(std::string(word.substr(colon + 1))) : nullptr;
            std::string_view element = word.substr(0, colon);
            if (element.empty()) {
                e.value = value;
                continue;
            }
            std::string_view row;
            if (const auto at = element.find('@'); at < element.size())
                row = element.substr(at + 1), element = element.substr(0, at);
            ChildRule child;
            child.value = value, child.inert = std::move(inert);
            child.most = std::numeric_limits<int>::max();
            const char often = element.back();
            if (often == '?' || often == '!' || often == '+' || often == '&') {
                element.remove_suffix(1);
                child.least = often == '!' || often == '+';
                if (often == '?' || often == '!') child.most = 1;
            }
            child.first_counts = open && child.most > 1 && often != '&';
            child.name = element;
            const auto rule = index.find(row.empty() ? element : row);
            child.rule = rule == index.end() || (value && row.empty()) ? &nothing_inside : rule->second;
            e.children.push_back(std::move(child));
        }
    for (ElementRule& e : elements)
        for (ChildRule& child : e.children)
            if (!child.value) child.value = child.rule->value;
    return std::move(*this);
}

}  // namespace forage::xml
