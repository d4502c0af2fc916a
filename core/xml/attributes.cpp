#include "core/xml/attributes.h"

#include <algorithm>

namespace forage::xml {
namespace {

/// Whether it is a number for which a struct can keep a formula.
bool is_number(const ValuePlace& place) {
    return std::holds_alternative<int*>(place) || std::holds_alternative<double*>(place);
}

void read_into(const ValuePlace& place, const Value& value, const AttributeRule& rule) {
    const auto& choices = rule.value.choices;
    const auto text = rule.relative_path ? model::resolved(value.text(), value.where()) : value.text();
    std::visit(
        [&]<class T>(T* to) {
            if constexpr (std::is_same_v<T, std::string>)
                *to = text;
            else if constexpr (std::is_same_v<T, model::Expression>)
                *to = {text, value.where()};
            else if constexpr (std::is_same_v<T, std::optional<double>>)
                *to = value.number();
            else if constexpr (std::is_same_v<T, std::optional<std::uint64_t>>)
                *to = value.count();
            else if constexpr (std::is_same_v<T, std::uint64_t>)
                *to = value.count().value_or(*to);
            else if constexpr (std::is_same_v<T, int>)
                *to = value.whole(*to);
            else if constexpr (std::is_same_v<T, double>)
                *to = value.number(*to);
            else if (const auto it = std::ranges::find(choices, value.view); it != choices.end())
                *to = static_cast<T>(it - choices.begin());
            else if constexpr (std::is_same_v<T, bool>)
                if (choices.empty()) *to = value.flag(*to);
        },
        place);
}

}  // namespace

ParameterValue value_in(const BoundAttribute& attribute, const void* s) {
    const auto& choices = attribute.rule.value.choices;
    // Members are found in structs that may change, and this changes none.
    return std::visit(
        [&]<class T>(const T* member) -> ParameterValue {
            constexpr bool is_text = std::is_same_v<T, std::string>;
            if constexpr (std::is_same_v<T, std::optional<double>>)
                return *member ? to_text(**member) : std::string();
            else if constexpr (std::is_class_v<T> && !is_text)
                return std::string();
            if constexpr (!std::is_class_v<T>)
                if (!choices.empty()) return choices[static_cast<std::size_t>(*member)];
            if constexpr (is_text || std::is_same_v<T, bool> || std::is_same_v<T, double>)
                return *member;
            else if constexpr (!std::is_class_v<T>)
                return static_cast<int>(*member);
        },
        attribute.member.in(const_cast<void*>(s)));
}

ElementRow::ElementRow(ElementRule r, std::type_index its_type, void* fresh,
                       std::vector<BoundAttribute> members, std::vector<AttributeRule> further,
                       KeepFormula* keep)
    : rule(std::move(r)), type(its_type), attributes(std::move(members)), keep_formula(keep) {
    for (const auto& attribute : attributes) {
        auto& its_rule = rule.attributes.emplace_back(attribute.rule);
        its_rule.value.formula = keep && is_number(attribute.member.in(fresh));
        if (!its_rule.required) its_rule.value.otherwise = to_text(value_in(attribute, fresh));
    }
    rule.attributes.insert(rule.attributes.end(), further.begin(), further.end());
}

void ElementRow::read_members(const Element& e, void* s) const {
    for (const auto& attribute : attributes) {
        const Value value = e[attribute.rule.name];
        const auto place = attribute.member.in(s);
        if (attribute.at) *attribute.at->in(s) = value.where();
        if (keep_formula && is_number(place) && in_braces(value.view))
            keep_formula(attribute, value, s);
        else
            read_into(place, value, attribute.rule);
    }
}

std::vector<ElementRule> rules_of(const std::vector<ElementRow>& rows) {
    std::vector<ElementRule> out;
    for (const auto& row : rows)
        if (!row.rule.name.empty()) out.push_back(row.rule);
    return out;
}

}  // namespace forage::xml
