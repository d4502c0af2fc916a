// Types that a system declares by equations.
#include <pybind11/stl.h>

#include "tools/python/system.h"
#include "tools/python/values.h"

namespace forage::python {
namespace {

using namespace py::literals;

/// Declares the type and returns its name, by which groups and connections use it.
template <void (*declare)(SystemFile&, model::TypeDeclaration)>
std::string add_type(PythonSystem& self, const std::string& name, const std::string& equations,
                     const py::dict& constants, const py::dict& states, const std::string& doc) {
    model::TypeDeclaration type;
    type.name = name, type.doc = doc;
    for (const auto& [key, value] : constants) {
        auto& c = type.constants.emplace_back();
        c.name = py::cast<std::string>(key), c.value = text_of(py::cast<py::object>(value));
    }
    for (const auto& [key, value] : states) {
        auto& s = type.states.emplace_back();
        s.name = py::cast<std::string>(key), s.value = text_of(py::cast<py::object>(value));
    }
    type.equations = {{equations, {}}};
    declare(self, std::move(type));
    return name;
}

}  // namespace

void add_system_types(py::class_<PythonSystem, std::shared_ptr<PythonSystem>>& system) {
    system
        .def("add_neuron_type", &add_type<declare_neuron_type>, "name"_a, "equations"_a, py::kw_only(),
             "constants"_a = py::dict(), "states"_a = py::dict(), "doc"_a = "",
             R"(Declares a neuron type by equations and returns its name.

    leaky = system.add_neuron_type("leaky", "dx/dt = (exc - inh - x) / tau; output x", constants={"tau": 0.05})
    cell = process.add_group("Cell", 10, type=leaky, tau=0.1)

The equations are those of a system file: a line or a ';' ends each. `constants` are the parameters of the type with their defaults, `states` the first values
of states that do not begin with 0; both are numbers, or formulas in braces. Raises InputError for mistakes in them and then changes nothing.)")
        .def("add_synapse_type", &add_type<declare_synapse_type>, "name"_a, "equations"_a, py::kw_only(),
             "constants"_a = py::dict(), "states"_a = py::dict(), "doc"_a = "",
             R"(Declares a synapse type by equations and returns its name, as add_neuron_type() does.

    hebb = system.add_synapse_type("hebb", "weight' = weight + eta * pre * post'; output psp = weight' * pre'", constants={"eta": 0.01}))");
}

}  // namespace forage::python
