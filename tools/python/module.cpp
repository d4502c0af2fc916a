// The module `_forage`, which the package `forage` re-exports.
#include <cstdlib>

#include <dlfcn.h>

#include "core/base/installation.h"
#include "tools/python/python.h"

namespace {

/// Finds the files that belong to Forage from this module on, as the running program is that of Python.
void find_installation() {
    Dl_info module;
    if (dladdr(reinterpret_cast<void*>(&find_installation), &module))
        forage::running_file() = std::filesystem::canonical(module.dli_fname);
    const auto fonts = forage::installation() / "share/forage/fonts/fonts.conf";  // of a wheel
    if (std::filesystem::exists(fonts)) setenv("FONTCONFIG_FILE", fonts.c_str(), 0);
}

}  // namespace

PYBIND11_MODULE(_forage, module) {
    using namespace forage::python;
    // Those of pybind11 have types of C++; see complete_functions() and forage/_forage.pyi.
    pybind11::options options;
    options.disable_function_signatures();
    module.attr("__version__") = FORAGE_VERSION;
    find_installation();
    module.attr("_systems") = (forage::installation() / "share/forage/systems").string();
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
    complete_functions(module);
}
