// Objects of Python that C++ owns in any thread.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "tools/python/python.h"

namespace forage::python {

/// Shares an object of Python. It may be copied and destroyed with or without the GIL, in any thread, and
/// when Python has ended.
using Held = std::shared_ptr<py::object>;

inline Held hold(py::object object) {
    return {new py::object(std::move(object)), [](py::object* p) {
                if (!Py_IsInitialized()) return (void)p->release(), delete p;
                const py::gil_scoped_acquire python;
                delete p;
            }};
}

/// What a function of Python raised, on its way through C++ that does not hold the GIL. RunError has it as
/// its cause.
class PythonFailure : public std::runtime_error {
  public:
    PythonFailure(const std::string& message, Held raised)
        : std::runtime_error(message), raised_(std::move(raised)) {}
    const py::object& raised() const { return *raised_; }

  private:
    Held raised_;
};

/// Whether Ctrl-C must wait until a cycle has ended, because types of Python take part in cycles.
bool has_python_types();

}  // namespace forage::python
