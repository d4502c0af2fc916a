// Systems as values, as Python sees them.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <forage/system.h>

#include "tools/python/python.h"

namespace forage::python {

/// A system.
struct PythonSystem : SystemFile, std::enable_shared_from_this<PythonSystem> {
    explicit PythonSystem(SystemFile file) : SystemFile(std::move(file)) {}
    model::System& use() { return model; }
    /// A copy, which other threads cannot change.
    SystemFile file() const { return static_cast<const SystemFile&>(*this); }
    std::vector<model::System> before;  ///< the system at the beginning of each with-block that is open
};

/// An item of a system, which is found by its id.
struct SystemItem {
    std::shared_ptr<PythonSystem> system;
    std::string id;
};
struct SystemProcess : SystemItem {
    /// The process. Throws InputError when it was removed.
    model::Process& use() const;
    static constexpr auto owner = model::Assignment::Owner::process;
};
struct SystemGroup : SystemItem {
    model::Group& use() const;
    static constexpr auto owner = model::Assignment::Owner::group;
};
struct SystemConnection : SystemItem {
    model::Connection& use() const;
    static constexpr auto owner = model::Assignment::Owner::connection;
};

/// The parameters of an item: of a group's neuron, a process's module, or a connection's synapse.
struct SystemParameters : SystemItem {
    model::Assignment::Owner owner;

    template <class Item>
    explicit SystemParameters(const Item& item) : SystemItem(item), owner(Item::owner) {}
    py::object get(const std::string& name) const;
    /// Throws InputError, as set() of several does.
    void set(const std::string& name, const py::object& value) const;
    /// Sets the parameters in `values`. Throws InputError.
    void set(const py::dict& values) const;
    std::vector<std::string> names() const;
};

/// The constants of a process, or those of the system as a whole when the id is empty.
struct SystemConstants : SystemItem {
    py::object get(const std::string& name) const;
    /// Throws InputError.
    void set(const std::string& name, const py::object& value) const;
    std::vector<std::string> names() const;
};

/// Items of one kind, as a tuple.
template <class Item, class Models>
py::tuple items(const std::shared_ptr<PythonSystem>& system, const Models& models) {
    py::list out;
    for (const auto& m : models) out.append(Item{{system, m.id}});
    return py::tuple(out);
}

/// Adds a property to a class that shows a part of a model: one of the model's members.
template <class Class, class Model, class T>
void add_member(Class& type, const char* name, T Model::*member, const char* doc) {
    using Self = typename Class::type;
    type.def_property(
        name, [member](Self& self) { return self.use().*member; },
        [member](Self& self, const T& value) { self.use().*member = value; }, doc);
}

/// Adds the class of constants to the class System.
void add_system_constants(py::handle system);
/// Adds the classes of its items to the class System.
void add_system_items(py::handle system);
void add_system_types(py::class_<PythonSystem, std::shared_ptr<PythonSystem>>& system);

/// The group that `group` is or names. Throws InputError.
SystemGroup group_of(PythonSystem& system, const py::object& group);
/// The item that `name` names: a SystemProcess, SystemGroup or SystemConnection. Throws InputError.
py::object item_of(PythonSystem& system, const std::string& name);

/// Calls `write`. Raises OSError when it throws std::runtime_error that is no InputError.
void writing(const std::function<void()>& write);

/// Throws InputError when `types`, a map of a registry, has no `type`.
template <class Types>
void require_type(const Types& types, const std::string& type, const char* kind) {
    if (!types.contains(type))
        throw InputError(std::string("there is no ") + kind + " type '" + type + "'",
                         suggest(type, names(types)));
}

}  // namespace forage::python
