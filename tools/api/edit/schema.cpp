#include "tools/api/edit/schema.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/diagnostic.h"
#include "core/base/printable.h"
#include "core/run/input_error.h"

namespace forage::schema {
namespace {

using Kind = ValueType::Kind;

/// A value in a message.
std::string shown(const json& value) {
    constexpr std::size_t max_size = 60;
    std::string out = value.dump(-1, ' ', false, json::error_handler_t::replace);
    if (out.size() > max_size) out = out.substr(0, max_size) + "...";
    return out;
}

bool in_range(const json& value, const ValueType& type) {
    const double number = value.get<double>();
    return std::isfinite(number) && number >= type.low && number <= type.high;
}

/// The kinds of plain values in words and in TypeScript, in the order of Kind.
constexpr std::pair<const char*, const char*> plain_kinds[] = {
    {"any value", "unknown"}, {"true or false", "boolean"}, {"a whole number", "number"},
    {"a number", "number"},   {"a text", "string"},         {"a path without control characters", "string"}};

const auto& plain(Kind kind) { return plain_kinds[static_cast<std::size_t>(kind)]; }

/// Whether a value has the kind of a type, apart from what is in it.
bool fits(const json& value, const ValueType& type) {
    const auto kind = type.kind;
    if (kind == Kind::boolean) return value.is_boolean();
    if (kind == Kind::list) return value.is_array();
    if (kind == Kind::record) return value.is_object();
    if (kind == Kind::whole || kind == Kind::number)
        return value.is_number() && in_range(value, type) &&
               (kind == Kind::number || std::trunc(value.get<double>()) == value.get<double>());
    if (kind == Kind::any) return true;
    return value.is_string() && (kind != Kind::path || !has_control(value.get<std::string>())) &&
           (kind != Kind::choice || contains(type.choices, value.get<std::string>()));
}

std::string range_in_words(const ValueType& type) {
    const bool low = std::isfinite(type.low), high = std::isfinite(type.high);
    if (low && high) return fmt::format(" from {} to {}", type.low, type.high);
    return low ? fmt::format(" of at least {}", type.low) : "";
}

ValueType of_kind(Kind kind) {
    ValueType out;
    out.kind = kind;
    return out;
}

ValueType in_range(Kind kind, double low, double high) {
    auto out = of_kind(kind);
    out.low = low, out.high = high;
    return out;
}

}  // namespace

ValueType any(std::string typescript_name) {
    ValueType out;
    out.typescript_name = std::move(typescript_name);
    return out;
}
ValueType boolean() { return of_kind(Kind::boolean); }
ValueType whole(double low, double high) { return in_range(Kind::whole, low, high); }
ValueType number(double low, double high) { return in_range(Kind::number, low, high); }
ValueType text() { return of_kind(Kind::text); }
ValueType path() { return of_kind(Kind::path); }
ValueType choice(std::vector<std::string> choices) {
    auto out = of_kind(Kind::choice);
    out.choices = std::move(choices);
    return out;
}
ValueType list(ValueType element, double max_elements) {
    auto out = of_kind(Kind::list);
    out.high = max_elements;
    out.element.push_back(std::move(element));
    return out;
}
ValueType record(std::vector<Member> members, std::string typescript_name) {
    auto out = of_kind(Kind::record);
    out.members = std::move(members), out.typescript_name = std::move(typescript_name);
    return out;
}
Member optional(std::string name, ValueType type, json otherwise, std::string doc) {
    return {std::move(name), std::move(type), std::move(doc), std::move(otherwise)};
}

std::optional<Mismatch> mismatch(const json& value, const ValueType& type, const std::string& where) {
    if (!fits(value, type)) return Mismatch{where, "is " + shown(value), in_words(type)};
    if (type.kind == Kind::record && !type.members.empty()) return mismatch(value, type.members, where);
    if (type.kind == Kind::list && static_cast<double>(value.size()) > type.high)
        return Mismatch{where, fmt::format("has {} elements", value.size()), in_words(type)};
    if (type.kind == Kind::list)
        for (std::size_t i = 0; i < value.size(); ++i)
            if (auto found = mismatch(value[i], type.element[0], fmt::format("{}[{}]", where, i)))
                return found;
    return std::nullopt;
}

std::optional<Mismatch> mismatch(const json& object, const std::vector<Member>& members,
                                 const std::string& where) {
    const auto path = [&](const std::string& name) { return where.empty() ? name : where + "." + name; };
    for (const auto& [name, member] : object.items())
        if (!contains(members, name, &Member::name))
            return Mismatch{path(name), "is not a member",
                            members.empty() ? "it has no members" : suggest(name, names_of(members))};
    for (const auto& m : members) {
        const auto it = object.find(m.name);
        if (m.required() && it == object.end()) return Mismatch{path(m.name), "is missing", in_words(m.type)};
        if (it == object.end() || (!m.required() && it->is_null())) continue;
        if (auto found = mismatch(*it, m.type, path(m.name))) return found;
    }
    return std::nullopt;
}

json checked(json object, const std::vector<Member>& members, const std::string& what) {
    if (const auto found = mismatch(object, members))
        throw InputError(fmt::format("{}: '{}' {}", what, found->where, found->what), found->allowed);
    for (const auto& m : members) {
        if (m.required() || m.type.kind == Kind::any) continue;
        if (object.value(m.name, json()).is_null()) object.erase(m.name);
        if (!m.otherwise.is_null()) object.emplace(m.name, m.otherwise);
    }
    return object;
}

std::string in_words(const ValueType& type) {
    if (type.kind == Kind::choice)
        return fmt::format("{} or {}", fmt::join(type.choices.begin(), std::prev(type.choices.end()), ", "),
                           type.choices.back());
    if (type.kind == Kind::list)
        return fmt::format("a list{}, each element {}",
                           std::isfinite(type.high) ? fmt::format(" of at most {}", type.high) : "",
                           in_words(type.element[0]));
    if (type.kind != Kind::record) return plain(type.kind).first + range_in_words(type);
    return type.members.empty() ? "an object"
                                : fmt::format("an object with {}", fmt::join(names_of(type.members), ", "));
}

std::string in_typescript(const ValueType& type) {
    if (!type.typescript_name.empty()) return type.typescript_name;
    if (type.kind == Kind::choice) return fmt::format("'{}'", fmt::join(type.choices, "' | '"));
    if (type.kind == Kind::list) return in_typescript(type.element[0]) + "[]";
    if (type.kind != Kind::record) return plain(type.kind).second;
    if (type.members.empty()) return "object";
    const auto members = collected(type.members, [](const Member& m) {
        return fmt::format("{}{}", m.name, m.required() ? ": " : "?: ") + in_typescript(m.type) +
               (m.required() ? "" : " | null");
    });
    return fmt::format("{{ {} }}", fmt::join(members, "; "));
}

}  // namespace forage::schema
