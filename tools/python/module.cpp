// The module `_forage`, which the package `forage` re-exports.
#include "tools/python/python.h"

PYBIND11_MODULE(_forage, module) {
    using namespace forage::python;
    module.attr("__version__") = FORAGE_VERSION;
    add_errors(module);
    add_groups(module);
    add_parameters(module);
    add_probes(module);
    add_runs(module);
}
