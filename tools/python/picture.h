// Pictures and films of a run as Python sees them.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "tools/python/run.h"

namespace forage::python {

/// A film of a run.
struct PythonFilm {
    std::shared_ptr<PythonRun> run;
    std::shared_ptr<RunFilm> film;
    std::string file;  ///< an absolute path

    bool complete() const { return !film->observer || run->closed(); }
    void close();
};

py::object plot(PythonRun& run, const std::string& picture, const std::string& format, std::size_t robot);
py::object diagram(PythonRun& run, const std::optional<std::string>& process, const std::string& format);
std::unique_ptr<PythonFilm> film(PythonRun& run, const std::filesystem::path& file,
                                 const std::vector<std::string>& groups);

}  // namespace forage::python
