// The types of the arguments of commands and operations: one description checks them, and is printed for the
// page and the docs.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/base/sequence.h"

namespace forage::schema {

using nlohmann::json;

struct Member;

/// A type of JSON values.
struct ValueType {
    enum class Kind { any, boolean, whole, number, text, path, choice, list, record };
    static constexpr double infinity = std::numeric_limits<double>::infinity();

    Kind kind = Kind::any;
    double low = -infinity, high = infinity;  ///< of a number; of a list, the most elements
    std::vector<std::string> choices = {};
    std::vector<ValueType> element = {};  ///< of a list: one
    std::vector<Member> members;          ///< of a record; one without members may have any
    std::string typescript_name = {};     ///< of the type in the page; empty for the plain one
};

/// A member of a record. A required one has no default; the default null means that it may be absent.
struct Member {
    std::string name;
    ValueType type;
    std::string doc = {};
    json otherwise = json(json::value_t::discarded);

    bool required() const { return otherwise.is_discarded(); }
};

ValueType any(std::string typescript_name = {});
ValueType boolean();
ValueType whole(double low = 0, double high = ValueType::infinity);
ValueType number(double low = -ValueType::infinity, double high = ValueType::infinity);
ValueType text();
ValueType path();  ///< a text without control characters, which would cut or hide a part of a name
ValueType choice(std::vector<std::string> choices);
ValueType list(ValueType element, double max_elements = ValueType::infinity);
ValueType record(std::vector<Member> members, std::string typescript_name = {});
Member optional(std::string name, ValueType type, json otherwise = nullptr, std::string doc = {});

/// Why a value does not have a type.
struct Mismatch {
    std::string where;    ///< such as "patterns[2]"
    std::string what;     ///< such as "is -1"
    std::string allowed;  ///< such as "a whole number from 1 to 9"
};

/// Compares a value with a type; empty when it has it. A null stands for an absent member.
std::optional<Mismatch> mismatch(const json& value, const ValueType& type, const std::string& where = {});

/// Compares the members of an object.
std::optional<Mismatch> mismatch(const json& object, const std::vector<Member>& members,
                                 const std::string& where = {});

/// The object with the defaults of absent members, and without nulls that stand for absent ones. Throws
/// InputError, whose message begins with `what`, when the object does not have these members.
json checked(json object, const std::vector<Member>& members, const std::string& what);

/// The values of a type in words.
std::string in_words(const ValueType& type);
std::string in_typescript(const ValueType& type);

}  // namespace forage::schema
