#include "tools/python/picture.h"

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "tools/python/values.h"

namespace forage::python {

void PythonFilm::close() {
    if (!complete()) run->finish_film(*film);
}

py::object plot(PythonRun& run, const std::string& picture, const std::string& format, std::size_t robot) {
    const std::string content =
        warned([&](Diagnostics* warnings) { return draw(run.use(), picture, format, robot, warnings); });
    const bool movie = picture.starts_with("movie:");
    return py::module_::import("forage._picture").attr("Picture")(py::bytes(content), movie ? "gif" : format);
}

py::object diagram(PythonRun& run, const std::optional<std::string>& process, const std::string& format) {
    return plot(run, process ? "diagram:" + *process : "diagram", format, 0);
}

std::unique_ptr<PythonFilm> film(PythonRun& run, const std::filesystem::path& file,
                                 const std::vector<std::string>& groups) {
    const std::string path = std::filesystem::absolute(file).string();
    auto made = run.add_film(forage::film(run.use(), path, groups));
    return std::make_unique<PythonFilm>(PythonFilm{run.shared_from_this(), std::move(made), path});
}

void add_pictures(py::module_& module) {
    py::class_<PythonFilm>(module, "Film", R"(A film of a run: with run.film("robot.gif"): run.run(trials=1).

Notebooks show it when it is closed.)")
        .def("close", &PythonFilm::close,
             "Completes the file. Does nothing when it is complete. Raises RuntimeError when it cannot be "
             "written.")
        .def_property_readonly("closed", &PythonFilm::complete, "Whether the film is complete.")
        .def_readonly("file", &PythonFilm::file, "The absolute path of the file.")
        .def_property_readonly(
            "frames", [](const PythonFilm& self) { return self.film->frames; },
            "The number of frames, once the film is complete.")
        .def("__enter__", [](const py::object& self) { return self; })
        .def("__exit__", [](PythonFilm& self, const py::args&) { self.close(); })
        .def("_repr_html_", html("film"))
        .def("__repr__", [](const PythonFilm& self) {
            return fmt::format("<forage.Film '{}'{}>", self.file, self.complete() ? "" : ", not complete");
        });
}

}  // namespace forage::python
