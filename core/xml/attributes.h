// Elements of XML files, the structs of the model that they describe, and the members that hold the values of
// their attributes.
#pragma once

#include <algorithm>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "core/model/system.h"
#include "core/types/parameter.h"
#include "core/xml/document.h"
#include "core/xml/rules.h"

namespace forage::xml {

/// An attribute and the member that holds its value. The default is the value of the member in a new
/// `Struct`. When the rule has choices, they are in the order of the member's values.
template <class Struct>
struct AttributeOf {
    std::variant<std::string Struct::*, int Struct::*, double Struct::*, bool Struct::*,
                 model::Direction Struct::*, InputKind Struct::*>
        member;
    AttributeRule rule;
    Location Struct::*at = nullptr;  ///< the member that holds the location of the value
};

/// The value of an attribute as a file has it.
template <class Struct>
ParameterValue value_of(const AttributeOf<Struct>& attribute, const Struct& s) {
    const auto& choices = attribute.rule.value.choices;
    return std::visit(
        [&]<class T>(T Struct::*member) -> ParameterValue {
            if constexpr (!std::is_enum_v<T>)
                if (choices.empty()) return s.*member;
            if constexpr (std::is_same_v<T, std::string>)
                return s.*member;
            else
                return choices[static_cast<std::size_t>(s.*member)];
        },
        attribute.member);
}

/// An element that describes a `Struct`. Its attributes are in the order in which they are written.
template <class Struct>
struct ElementOf {
    std::string name = {}, doc = {};
    std::string_view content = {};
    std::vector<AttributeOf<Struct>> attributes = {};
    std::vector<AttributeRule> further_attributes = {};  ///< whose values are members of another struct
    int choose = 0;
    bool or_none = false;

    std::vector<AttributeRule> rules() const {
        std::vector<AttributeRule> out;
        for (const auto& attribute : attributes) {
            auto& rule = out.emplace_back(attribute.rule);
            if (!rule.required) rule.value.otherwise = to_text(value_of(attribute, Struct()));
        }
        out.insert(out.end(), further_attributes.begin(), further_attributes.end());
        return out;
    }
    operator ElementRule() const { return {name, doc, content, rules(), choose, or_none}; }

    /// Reads the attributes. A member keeps its value when the file does not have the attribute, or when the
    /// attribute's value is not valid.
    void read(const Element& e, Struct& s) const {
        for (const auto& attribute : attributes) {
            const Value value = e[attribute.rule.name];
            const auto& choices = attribute.rule.value.choices;
            if (attribute.at) s.*attribute.at = value.where();
            std::visit(
                [&]<class T>(T Struct::*member) {
                    T& to = s.*member;
                    if constexpr (std::is_same_v<T, std::string>)
                        to = value.view;
                    else if constexpr (std::is_same_v<T, int>)
                        to = value.whole(to);
                    else if constexpr (std::is_same_v<T, double>)
                        to = value.number(to);
                    else if (const auto it = std::ranges::find(choices, value.view); it != choices.end())
                        to = static_cast<T>(it - choices.begin());
                    else if constexpr (std::is_same_v<T, bool>)
                        if (choices.empty()) to = value.flag(to);
                },
                attribute.member);
        }
    }
};

template <class Struct>
ElementOf<Struct> element(std::string name, std::string doc, std::string_view content,
                          std::vector<AttributeOf<Struct>> attributes,
                          std::vector<AttributeRule> further_attributes = {}) {
    return {std::move(name), std::move(doc), content, std::move(attributes), std::move(further_attributes)};
}

}  // namespace forage::xml
