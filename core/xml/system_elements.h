// The elements and attributes of system and process files, with the original's spellings, and the members of
// the model that hold their values. The check, the schema, the reference, the reader and the writer use this
// table.
#pragma once

#include "core/xml/attributes.h"

namespace forage::xml {

/// A column or row of a cell, or pixels.
AttributeRule coordinate(std::string_view name, std::string_view doc);

/// The table, in the order of the reference.
const std::vector<ElementRow>& system_elements();
/// The row of the element that describes structs of a type.
const ElementRow& row_of(std::type_index type);

/// The element that describes a `Struct`.
template <class Struct>
const ElementRow& element_of() {
    static const ElementRow& row = row_of(typeid(Struct));
    return row;
}

/// Makes `out` the alternative that elements called `name` describe, and calls read(element, alternative).
/// Returns whether there is one.
template <class... Structs, class Read>
bool read_alternative(std::string_view name, std::variant<Structs...>& out, Read read) {
    const auto try_one = [&]<class Struct>(std::type_identity<Struct>) {
        const auto& row = element_of<Struct>();
        if (name != row.rule.name) return false;
        read(row, out.template emplace<Struct>());
        return true;
    };
    return (try_one(std::type_identity<Structs>()) || ...);
}

}  // namespace forage::xml
