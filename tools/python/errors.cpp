// Exceptions of the library as those of forage/_errors.py.
#include "core/base/archive.h"
#include "core/base/named_file.h"
#include "core/run/checkpoint_file.h"
#include "tools/python/held.h"
#include "tools/python/python.h"

namespace forage::python {
namespace {

py::object python_class(const char* name) { return py::module_::import("forage._errors").attr(name); }

py::object diagnostic(const Diagnostic& d) {
    const bool in_file = d.where.file != nullptr;
    const auto number = [](int n) { return n > 0 ? py::object(py::int_(n)) : py::none(); };
    return python_class("Diagnostic")(d.severity == Severity::error ? "error" : "warning", d.message, d.hint,
                                      in_file ? py::object(py::str(d.where.file->path)) : py::none(),
                                      number(d.where.line), number(d.where.column), format(d));
}

/// The mistakes with hints for programs in Python: a type that is missing may be a class.
Diagnostics for_python(const Diagnostics& found) {
    Diagnostics out;
    for (Diagnostic d : found.all()) {
        for (const std::string kind : {"neuron", "synapse", "module"})
            if (d.message.starts_with("there is no " + kind + " type "))
                d.hint +=
                    (d.hint.empty() ? "" : "; ") + ("@forage." + kind + " declares a class of Python as one");
        out.add(std::move(d));
    }
    return out;
}

void raise(const InputError& e) {
    py::list all;
    const Diagnostics found = for_python(e.diagnostics());
    for (const auto& d : found.all()) all.append(diagnostic(d));
    const py::object type = python_class("InputError");
    PyErr_SetObject(type.ptr(), type(format(found), all).ptr());
}

/// The exception of Python that made a type fail; null when it was none.
py::object cause_of(const std::exception& e) {
    try {
        std::rethrow_if_nested(e);
    } catch (const PythonFailure& failure) {
        return failure.raised();
    } catch (const std::exception& inner) {
        return cause_of(inner);
    } catch (...) {
    }
    return {};
}

void raise(const engine::RunError& e) {
    const py::object type = python_class("RunError"), error = type(e.what());
    if (py::object cause = cause_of(e)) PyException_SetCause(error.ptr(), cause.release().ptr());
    PyErr_SetObject(type.ptr(), error.ptr());
}

}  // namespace

void warn(const Diagnostics& diagnostics) {
    for (const auto& d : diagnostics.all())
        if (d.severity == Severity::warning &&
            PyErr_WarnEx(python_class("InputWarning").ptr(), format(d).c_str(), 1) != 0)
            throw py::error_already_set();
}

void add_errors(py::module_&) {
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            if (thrown) std::rethrow_exception(std::move(thrown));
        } catch (const InputError& e) {
            raise(e);
        } catch (const FileError& e) {
            Diagnostics found;
            report(e, found);
            raise(InputError(std::move(found)));
        } catch (const CheckpointError& e) {
            raise(InputError(e.what()));
        } catch (const ArchiveError& e) {
            raise(InputError(e.what()));
        } catch (const engine::RunError& e) {
            raise(e);
        } catch (const py::cast_error& e) {
            PyErr_SetString(PyExc_TypeError, e.what());
        }
    });
}

}  // namespace forage::python
