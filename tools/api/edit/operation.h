// An operation of an editor as a value: what it is called, its members, and what carries it out.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/base/diagnostic.h"
#include "core/run/input_error.h"
#include "tools/api/edit/schema.h"

namespace forage::editing {

using nlohmann::json;

/// `Edit` has what an operation works on, and the operation itself in its member `o`.
template <class Edit>
struct Operation {
    std::string name, doc;
    std::vector<schema::Member> members;
    json (Edit::*apply)();  ///< returns the id that it made, a list of them, or null
};

/// Carries out the operation whose name is its member `do`. Throws InputError for one that does not exist,
/// and for wrong members.
template <class Edit>
json carry_out(const std::vector<Operation<Edit>>& all, json operation, Edit edit) {
    const auto name = operation.find("do");
    if (name == operation.end() || !name->is_string())
        throw InputError("'do' is missing in an operation",
                         R"(such as {"do": "rename", "id": "a", "name": "B"})");
    const auto what = name->template get<std::string>();
    operation.erase(name);
    const auto* found = find_by(all, what, &Operation<Edit>::name);
    if (!found) throw InputError("there is no operation '" + what + "'", suggest(what, names_of(all)));
    edit.o = schema::checked(std::move(operation), found->members, "operation '" + what + "'");
    return (edit.*found->apply)();
}

}  // namespace forage::editing
