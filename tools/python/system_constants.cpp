// The constants of a system and of its processes.
#include <algorithm>
#include <functional>

#include <fmt/format.h>

#include "core/base/sequence.h"
#include "tools/python/system.h"
#include "tools/python/values.h"

namespace forage::python {
namespace {

/// The constants in `system`, the system of `self` or a copy of it. Throws InputError when their process was
/// removed.
std::vector<model::Constant>& constants_of(const SystemConstants& self, model::System& system) {
    if (self.id.empty()) return system.constants;
    SystemProcess{self}.use();
    return model::find_process(system, self.id)->constants;
}

std::vector<model::Constant>::iterator find(std::vector<model::Constant>& all, const std::string& name) {
    return std::ranges::find(all, name, &model::Constant::name);
}

/// Changes the constants, or nothing when a formula is wrong then.
void change(const SystemConstants& self, const std::function<void(std::vector<model::Constant>&)>& f) {
    model::System changed = self.system->model;
    f(constants_of(self, changed));
    Diagnostics diagnostics;
    model::compute(changed, diagnostics);
    throw_errors(diagnostics);
    self.system->model = std::move(changed);
}

void require(const SystemConstants& self, const std::string& name) {
    const auto names = self.names();
    if (!contains(names, name))
        throw InputError(fmt::format("there is no constant '{}'", name), suggest(name, names));
}

void remove(const SystemConstants& self, const std::string& name) {
    require(self, name);
    change(self, [&](auto& constants) { constants.erase(find(constants, name)); });
}

}  // namespace

std::vector<std::string> SystemConstants::names() const {
    return forage::names_of(constants_of(*this, system->model));
}

py::object SystemConstants::get(const std::string& name) const {
    require(*this, name);
    const auto* process = id.empty() ? nullptr : model::find_process(system->model, id);
    const auto value =
        model::Constants(system->model).value(find(constants_of(*this, system->model), name)->value, process);
    return py::cast(value);
}

void SystemConstants::set(const std::string& name, const py::object& value) const {
    change(*this, [&](auto& constants) {
        auto it = find(constants, name);
        if (it == constants.end()) {
            it = constants.emplace(it);
            it->name = name;
        }
        it->value = text_of(value);
    });
}

void add_system_constants(py::handle scope) {
    py::class_<SystemConstants> type(
        scope, "Constants",
        R"(The constants of a system or of one of its processes, by name: system.constants["lambda"] = 0.2.

A value is a number, or a formula of other constants in braces: "{2 * lambda}". Parameters use them in formulas, too, and follow them:
group.params["threshold"] = "{1 + lambda}". A value after which a formula has no value raises InputError and changes nothing.)");
    type.def(
            "__delitem__", [](const SystemConstants& self, const std::string& name) { remove(self, name); },
            py::arg("name"))
        .def("__repr__", [](const SystemConstants& self) {
            std::string out;
            for (const auto& c : constants_of(self, self.system->model))
                out += fmt::format("{}{}={}", out.empty() ? "" : ", ", c.name, c.value);
            return fmt::format("<forage.System.Constants: {}>", out);
        });
    add_mapping(type);
}

}  // namespace forage::python
