// Elements of XML files, the structs of the model that they describe, and the members that hold the values of
// their attributes.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <typeindex>
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

/// A member of a struct. It does not know the type of the struct, so that what uses it is compiled once.
/// `Place` is made from a pointer to the member.
template <class Place>
class Member {
  public:
    template <class Struct, class T>
    Member(T Struct::*member)
        : bits_(std::bit_cast<std::ptrdiff_t>(member)), find_([](std::ptrdiff_t bits, void* s) -> Place {
              return &(static_cast<Struct*>(s)->*std::bit_cast<T Struct::*>(bits));
          }) {}

    /// The member of `s`, a struct of the type that has it.
    Place in(void* s) const { return find_(bits_, s); }
    /// What the member was made from; `Pointer` is its type.
    template <class Pointer>
    Pointer as() const {
        return std::bit_cast<Pointer>(bits_);
    }

  private:
    std::ptrdiff_t bits_;
    Place (*find_)(std::ptrdiff_t, void*);
};

/// Where the value of an attribute is.
using ValuePlace =
    std::variant<std::string*, int*, double*, bool*, model::Direction*, InputKind*, model::Expression*,
                 std::uint64_t*, std::optional<std::uint64_t>*, std::optional<double>*>;

/// An attribute and the member that holds its value. The default is the value of the member in a new struct.
/// When the rule has choices, they are in the order of the member's values.
struct BoundAttribute {
    Member<ValuePlace> member;
    AttributeRule rule;
    std::optional<Member<Location*>> at = {};  ///< the member that holds the location of the value
};

/// An attribute of an element that describes a `Struct`.
template <class Struct>
struct AttributeOf : BoundAttribute {
    /// `holder` is a member of `Struct` or of its base.
    template <class Owner, class T>
    AttributeOf(T Owner::*holder, AttributeRule its_rule)
        : BoundAttribute{static_cast<T Struct::*>(holder), std::move(its_rule)} {}
    template <class Owner, class T>
    AttributeOf(T Owner::*holder, AttributeRule its_rule, Location Struct::*location)
        : BoundAttribute{static_cast<T Struct::*>(holder), std::move(its_rule), location} {}
};

template <class Struct>
std::vector<BoundAttribute> attributes_of(std::initializer_list<AttributeOf<Struct>> list) {
    std::vector<BoundAttribute> out;
    for (const auto& a : list) out.push_back(a);
    return out;
}

/// The value of an attribute as a file has it; empty for a member that may be empty. `s` has the attribute's
/// member.
ParameterValue value_in(const BoundAttribute& attribute, const void* s);
template <class Struct>
ParameterValue value_of(const BoundAttribute& attribute, const Struct& s) {
    return value_in(attribute, &s);
}

/// A row of a table: an element and, when its attributes are members of a struct, where these are.
struct ElementRow {
    using KeepFormula = void(const BoundAttribute& attribute, const Value& value, void* s);

    ElementRule rule;
    std::type_index type = typeid(void);          ///< of the struct; void when there is none
    std::vector<BoundAttribute> attributes = {};  ///< in the order in which they are written
    KeepFormula* keep_formula = nullptr;          ///< null when the struct keeps no formulas for its numbers

    ElementRow(ElementRule r) : rule(std::move(r)) {}
    /// `fresh` is a new struct; `further` are attributes whose values are members of another one.
    ElementRow(ElementRule r, std::type_index type, void* fresh, std::vector<BoundAttribute> attributes,
               std::vector<AttributeRule> further, KeepFormula* keep_formula);

    /// Reads the attributes. A member keeps its value when the file does not have the attribute, or when the
    /// attribute's value is not valid.
    template <class Struct>
    void read(const Element& e, Struct& s) const {
        read_members(e, &s);
    }

  private:
    void read_members(const Element& e, void* s) const;
};

/// A struct that keeps formulas for its numbers.
template <class Struct>
concept HasFormulas = requires(Struct s) {
    s.formulas;
};

/// The formula that gives an attribute its value; null when there is none.
template <class Struct>
const std::string* formula_of(const BoundAttribute& attribute, const Struct& s) {
    if constexpr (HasFormulas<Struct>)
        for (const auto& f : s.formulas)
            if (f.attribute == attribute.rule.name && f.holds(s)) return &f.text;
    return nullptr;
}

/// Keeps the formula that a file has for a number.
template <HasFormulas Struct>
void keep_formula(const BoundAttribute& attribute, const Value& value, void* s) {
    auto& to = *static_cast<Struct*>(s);
    const auto& rule = attribute.rule.value;
    const auto keep = [&]<class T>(T Struct::*member) {
        constexpr double largest = std::numeric_limits<T>::max();
        to.formulas.push_back({member, attribute.rule.name, value.text(), std::max(rule.low, -largest),
                               std::min(rule.high, largest), false, 0, value.where()});
    };
    if (std::holds_alternative<int*>(attribute.member.in(s)))
        keep(attribute.member.template as<int Struct::*>());
    else
        keep(attribute.member.template as<double Struct::*>());
}

/// The row of an element that describes a `Struct`; `further` are attributes whose values are members of
/// another one.
template <class Struct>
ElementRow element(ElementRule rule, std::vector<BoundAttribute> attributes,
                   std::vector<AttributeRule> further = {}) {
    Struct fresh{};
    ElementRow::KeepFormula* keep = nullptr;
    if constexpr (HasFormulas<Struct>) keep = keep_formula<Struct>;
    return {std::move(rule), typeid(Struct), &fresh, std::move(attributes), std::move(further), keep};
}
template <class Struct>
ElementRow element(ElementRule rule, std::initializer_list<AttributeOf<Struct>> attributes,
                   std::vector<AttributeRule> further = {}) {
    return element<Struct>(std::move(rule), attributes_of(attributes), std::move(further));
}

/// The rules of a table, without rows that have no name.
std::vector<ElementRule> rules_of(const std::vector<ElementRow>& rows);

}  // namespace forage::xml
