// The module `_forage`, which the package `forage` re-exports.
#include "tools/python/python.h"

PYBIND11_MODULE(_forage, module) {
    using namespace forage::python;
    // The signatures are in forage/_forage.pyi, in the words of Python.
    pybind11::options options;
    options.disable_function_signatures();
    module.attr("__version__") = FORAGE_VERSION;
    add_agents(module);
    add_errors(module);
    add_groups(module);
    add_connections(module);
    add_parameters(module);
    add_pictures(module);
    add_probes(module);
    add_runs(module);
    add_wiring(module);
    add_systems(module);
    add_experiments(module);
    add_types(module);
}
