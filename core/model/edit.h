// Changes to the parameters of a system, as users write them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/model/system.h"
#include "core/types/registry.h"

namespace forage::model {

/// A parameter of a group, process or connection, or a constant, and a valid value for it.
struct Assignment {
    enum class Owner { group, process, connection, constant };

    Owner owner = Owner::group;  ///< the kind of the item that has the neuron, module or synapse
    std::string id;  ///< the id of the group, process or connection; the name of a constant (find_constant())
    const Parameter* parameter =
        nullptr;           ///< one of the owner's type; null for a constant and for a process's enableModule
    ParameterValue value;  ///< a relative path starts at the working directory
    std::string text;      ///< "WHERE.parameter=value", as written
    Location at;           ///< the location of the text; without a file: the command line
};

/// Calls f(owner, item, use) with each process, group and connection, and its use of a type: null without
/// one.
template <class S, class F>  // System or const System
void each_item(S& system, F f) {
    for (auto& p : system.processes) {
        f(Assignment::Owner::process, p, p.module ? &*p.module : nullptr);
        for (auto& g : p.groups) f(Assignment::Owner::group, g, &g.neuron);
    }
    for (auto& c : system.connections) f(Assignment::Owner::connection, c, c.synapse ? &*c.synapse : nullptr);
}

/// The use of a type in the group, process or connection with this id; null when there is none.
template <class S>  // System or const System
auto* find_use(S& system, std::string_view id) {
    std::conditional_t<std::is_const_v<S>, const TypeUse, TypeUse>* out = nullptr;
    each_item(system, [&](auto, auto& item, auto* use) {
        if (item.id == id) out = use;
    });
    return out;
}

/// The parameters of a neuron, module or synapse type, by the kind of the items that use it; null when the
/// type is unknown.
const std::vector<Parameter>* parameters_of(const Registry& registry, Assignment::Owner owner,
                                            std::string_view type);

/// Reads "WHERE.parameter=value", or "CONSTANT=value", where the value may be a formula in braces. WHERE is a
/// group ("Process/Group": a parameter of its neuron), a process
/// ("Process": a parameter of its module, or enableModule) or a connection (its name or id: a parameter of
/// its synapse). Reports unknown names, with those that exist, and wrong values, which are checked like those
/// of a file. `what` says where the text is from, such as "--set"; `at` and `value_at` are as in Expression.
/// Empty when there was an error. The result refers to `registry`.
std::optional<Assignment> parse_assignment(const System& system, const Registry& registry,
                                           std::string_view text, std::string_view what,
                                           Diagnostics& diagnostics, Location at = {},
                                           Location value_at = {});

/// The WHERE of assignments to an item: its path or name, or its id when that does not name it alone; in
/// double quotes when it contains '='.
std::string assignment_name(const System& system, Assignment::Owner owner, const std::string& id);
/// An assignment of a parameter as parse_assignment() reads it in a system.
std::string assignment_text(const System& system, const Assignment& assignment);

/// The parameter that "WHERE.parameter" names, without a value. Reports mistakes like parse_assignment().
std::optional<Assignment> find_parameter(const System& system, const Registry& registry,
                                         std::string_view name, std::string_view what,
                                         Diagnostics& diagnostics);
/// The names of all parameters of groups, enabled modules and connections, as find_parameter() takes them.
std::vector<std::string> parameter_names(const System& system, const Registry& registry);

/// Sets the parameter in the system, which must be the one that parse_assignment() was given.
void set(System& system, const Assignment& assignment);
/// A copy of the system in which the parameter is set.
System with(const System& system, const Assignment& assignment);
/// The value that the system has for a parameter: what its file sets, or the default of its type.
ParameterValue value_of(const System& system, const Assignment& parameter);
/// Gives a parameter its default.
void unset(System& system, const Assignment& parameter);

/// The kind and the id of the group, process or connection that `where` names, as before the dot of an
/// assignment. Reports mistakes like parse_assignment().
std::optional<Assignment> find_item(const System& system, std::string_view where, std::string_view what,
                                    Diagnostics& diagnostics);

/// The links and the names of files in a system are relative to its file. Changes them so that they are valid
/// from the file `to` instead of `from`.
void move_files(System& system, const std::string& from, const std::string& to, const Registry& registry);

/// Reads an assignment from the command line (--set) or from a file, and applies it to the system.
void set(System& system, const Registry& registry, std::string_view assignment, Diagnostics& diagnostics,
         Location at = {}, Location value_at = {});

}  // namespace forage::model
