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
};
struct SystemGroup : SystemItem {
    model::Group& use() const;
};
struct SystemConnection : SystemItem {
    model::Connection& use() const;
};

/// The parameters of an item: of a group's neuron, a process's module, or a connection's synapse.
struct SystemParameters {
    std::shared_ptr<PythonSystem> system;
    model::Assignment::Owner owner;
    std::string id;

    /// Sets the parameters in `values`. Throws InputError.
    void set(const py::dict& values) const;
    std::vector<std::string> names() const;
};

/// Adds the classes of its items to the class System.
void add_system_items(py::handle system);

/// The group that `group` is or names. Throws InputError.
SystemGroup group_of(PythonSystem& system, const py::object& group);
/// The item that `name` names: a SystemProcess, SystemGroup or SystemConnection. Throws InputError.
py::object item_of(PythonSystem& system, const std::string& name);

/// Calls `write`. Raises OSError when it throws std::runtime_error.
void writing(const std::function<void()>& write);

/// Throws InputError when `types`, a map of a registry, has no `type`.
template <class Types>
void require_type(const Types& types, const std::string& type, const char* kind) {
    if (!types.contains(type))
        throw InputError(std::string("there is no ") + kind + " type '" + type + "'",
                         suggest(type, names(types)));
}

}  // namespace forage::python
