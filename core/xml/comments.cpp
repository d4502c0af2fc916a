#include "core/xml/comments.h"

#include <string_view>

#include <tinyxml2.h>

namespace forage::xml {
namespace {

bool is_owner(const tinyxml2::XMLElement& e) {
    const std::string_view name = e.Name();
    return name == "Process" || name == "Group" || name == "Connection";
}

}  // namespace

Comments::Comments(const tinyxml2::XMLElement& root) {
    for (const auto* node = root.GetDocument()->FirstChild(); node; node = node->NextSibling())
        if (const auto* comment = node->ToComment()) by_owner_[&root].emplace_back(comment->Value());
    collect(root, root);
}

void Comments::collect(const tinyxml2::XMLNode& parent, const tinyxml2::XMLElement& owner) {
    std::vector<std::string> waiting;
    const auto give = [&](const tinyxml2::XMLElement& to) {
        auto& list = by_owner_[&to];
        list.insert(list.end(), waiting.begin(), waiting.end());
        waiting.clear();
    };
    for (const auto* node = parent.FirstChild(); node; node = node->NextSibling()) {
        if (const auto* comment = node->ToComment()) waiting.emplace_back(comment->Value());
        const auto* element = node->ToElement();
        if (!element) continue;
        const auto& next = is_owner(*element) ? *element : owner;
        give(next);
        collect(*element, next);
    }
    give(owner);
}

std::vector<std::string> Comments::of(const tinyxml2::XMLElement& element) const {
    const auto it = by_owner_.find(&element);
    return it == by_owner_.end() ? std::vector<std::string>() : it->second;
}

}  // namespace forage::xml
