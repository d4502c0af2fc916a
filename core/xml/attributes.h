// Elements of XML files, the structs of the model that they describe, and the members that hold the values of
// their attributes.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "core/formula/formula.h"
#include "core/model/expression.h"
#include "core/model/lookup.h"
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
                 model::Direction Struct::*, InputKind Struct::*, model::Expression Struct::*,
                 std::uint64_t Struct::*, std::optional<std::uint64_t> Struct::*,
                 std::optional<double> Struct::*>
        member;
    AttributeRule rule;
    Location Struct::*at = nullptr;  ///< the member that holds the location of the value
};

/// The value of an attribute as a file has it; empty for a member that may be empty.
template <class Struct>
ParameterValue value_of(const AttributeOf<Struct>& attribute, const Struct& s) {
    const auto& choices = attribute.rule.value.choices;
    return std::visit(
        [&]<class T>(T Struct::*member) -> ParameterValue {
            constexpr bool is_text = std::is_same_v<T, std::string>;
            if constexpr (std::is_same_v<T, std::optional<double>>)
                return s.*member ? to_text(*(s.*member)) : std::string();
            else if constexpr (std::is_class_v<T> && !is_text)
                return std::string();
            if constexpr (!std::is_class_v<T>)
                if (!choices.empty()) return choices[static_cast<std::size_t>(s.*member)];
            if constexpr (is_text || std::is_same_v<T, bool> || std::is_same_v<T, double>)
                return s.*member;
            else if constexpr (!std::is_class_v<T>)
                return static_cast<int>(s.*member);
        },
        attribute.member);
}

/// A struct that keeps formulas for its numbers.
template <class Struct>
concept HasFormulas = requires(Struct s) {
    s.formulas;
};

/// The formula that gives an attribute its value; null when there is none.
template <class Struct>
const std::string* formula_of(const AttributeOf<Struct>& attribute, const Struct& s) {
    if constexpr (HasFormulas<Struct>)
        for (const auto& f : s.formulas)
            if (f.attribute == attribute.rule.name && f.holds(s)) return &f.text;
    return nullptr;
}

/// An element that describes a `Struct`. Its attributes are in the order in which they are written.
template <class Struct>
struct ElementOf {
    std::string name = {}, doc = {}, content = {};
    std::vector<AttributeOf<Struct>> attributes = {};
    std::vector<AttributeRule> further_attributes = {};  ///< whose values are members of another struct
    int choose = 0;
    bool or_none = false;

    std::vector<AttributeRule> rules() const {
        std::vector<AttributeRule> out;
        for (const auto& attribute : attributes) {
            auto& rule = out.emplace_back(attribute.rule);
            rule.value.formula = may_be_formula(attribute);
            if (!rule.required) rule.value.otherwise = to_text(value_of(attribute, Struct()));
        }
        out.insert(out.end(), further_attributes.begin(), further_attributes.end());
        return out;
    }
    /// Whether the value is a number for which the struct can keep a formula.
    static bool may_be_formula(const AttributeOf<Struct>& attribute) {
        if constexpr (HasFormulas<Struct>)
            return std::holds_alternative<int Struct::*>(attribute.member) ||
                   std::holds_alternative<double Struct::*>(attribute.member);
        return false;
    }
    operator ElementRule() const { return {name, doc, content, rules(), choose, or_none}; }

    /// Reads the attributes. A member keeps its value when the file does not have the attribute, or when the
    /// attribute's value is not valid.
    void read(const Element& e, Struct& s) const {
        for (const auto& attribute : attributes) {
            const Value value = e[attribute.rule.name];
            const auto& choices = attribute.rule.value.choices;
            const auto text =
                attribute.rule.relative_path ? model::resolved(value.text(), value.where()) : value.text();
            if (attribute.at) s.*attribute.at = value.where();
            std::visit(
                [&]<class T>(T Struct::*member) {
                    T& to = s.*member;
                    if constexpr (HasFormulas<Struct>)
                        if constexpr (std::is_same_v<T, int> || std::is_same_v<T, double>)
                            if (in_braces(value.view)) {
                                constexpr double largest = std::is_same_v<T, int>
                                                               ? std::numeric_limits<int>::max()
                                                               : std::numeric_limits<double>::max();
                                const auto& rule = attribute.rule.value;
                                s.formulas.push_back({member, attribute.rule.name, text,
                                                      std::max(rule.low, -largest),
                                                      std::min(rule.high, largest), false, 0, value.where()});
                                return;
                            }
                    if constexpr (std::is_same_v<T, std::string>)
                        to = text;
                    else if constexpr (std::is_same_v<T, model::Expression>)
                        to = {text, value.where()};
                    else if constexpr (std::is_same_v<T, std::optional<double>>)
                        to = value.number();
                    else if constexpr (std::is_same_v<T, std::optional<std::uint64_t>>)
                        to = value.count();
                    else if constexpr (std::is_same_v<T, std::uint64_t>)
                        to = value.count().value_or(to);
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
ElementOf<Struct> element(std::string name, std::string doc, std::string content,
                          std::vector<AttributeOf<Struct>> attributes,
                          std::vector<AttributeRule> further_attributes = {}) {
    return {std::move(name), std::move(doc), std::move(content), std::move(attributes),
            std::move(further_attributes)};
}

}  // namespace forage::xml
