// What all functions of the module share: signatures for inspect.signature(), and one sentence about
// arguments of wrong types. pybind11 has neither in a form that users of Python know, so both are added here,
// once.
#include <cstdlib>
#include <cstring>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tools/python/python.h"
#include "tools/python/values.h"

namespace forage::python {
namespace {

using Record = py::detail::function_record;

/// What pybind11 keeps of a function, in a capsule.
const Record* record_in(PyObject* capsule) {
    return static_cast<const Record*>(PyCapsule_GetPointer(capsule, PyCapsule_GetName(capsule)));
}

/// What pybind11 knows of a function of C; null when it is not its own.
const Record* record_of(PyObject* function) {
    PyObject* self = PyCFunction_GET_SELF(function);
    if (!self || !PyCapsule_CheckExact(self)) return nullptr;
    return record_in(self);
}

/// "(self, source, every=1)", as Python reads it.
std::string signature(const Record& r) {
    const std::size_t all = r.nargs - (r.has_kwargs ? 1U : 0U);
    const auto name = [&](std::size_t i) -> std::string {
        if (i < r.args.size() && r.args[i].name && *r.args[i].name) return r.args[i].name;
        return i == 0 && r.is_method ? "self" : fmt::format("arg{}", i - (r.is_method ? 1U : 0U));
    };
    const auto parameter = [&](std::size_t i) {
        if (i >= r.args.size() || !r.args[i].value) return name(i);
        return fmt::format("{}={}", name(i), py::repr(r.args[i].value).cast<std::string>());
    };
    std::vector<std::string> out;
    for (std::size_t i = 0; i < r.nargs_pos; ++i) out.push_back(parameter(i));
    if (r.args.empty() && r.nargs_pos > 0) out.emplace_back("/");  // arguments without names
    const std::size_t named = r.nargs_pos + (r.has_args ? 1U : 0U);
    if (r.has_args)
        out.emplace_back("*args");
    else if (named < all)
        out.emplace_back("*");
    for (std::size_t i = named; i < all; ++i) out.push_back(parameter(i));
    if (r.has_kwargs) out.emplace_back("**kwargs");
    return fmt::format("({})", fmt::join(out, ", "));
}

PyCFunctionWithKeywords dispatcher = nullptr;  ///< that of pybind11, which all its functions share

/// What is wrong with the arguments, in one sentence; with `fractions`, empty when none is a fraction where
/// an integer belongs.
py::object sentence(PyObject* self, PyObject* arguments, PyObject* keywords, bool fractions) {
    const Record* r = record_in(self);
    const py::object explain = py::module_::import("forage._errors").attr("wrong_arguments");
    return explain(r->name, r->signature, py::reinterpret_borrow<py::object>(arguments),
                   keywords ? py::reinterpret_borrow<py::object>(keywords) : py::dict(), r->is_constructor,
                   py::handle(r->scope).attr("__name__"), fractions);
}

/// Whether a value is a number such as numpy.float32(1.5), which pybind11 would round to an integer.
bool may_be_fraction(PyObject* value) {
    return PyNumber_Check(value) && !PyFloat_Check(value) && !is_integer(value);
}

/// Whether one of the arguments is such a number, and an integer is needed. Raises TypeError then.
bool refused(PyObject* self, PyObject* arguments, PyObject* keywords) {
    bool maybe = false;
    for (Py_ssize_t i = 0; i < PyTuple_GET_SIZE(arguments); ++i)
        maybe = maybe || may_be_fraction(PyTuple_GET_ITEM(arguments, i));
    PyObject *name = nullptr, *value = nullptr;
    for (Py_ssize_t at = 0; keywords && PyDict_Next(keywords, &at, &name, &value);)
        maybe = maybe || may_be_fraction(value);
    const Record* r = record_in(self);
    if (!maybe || !std::strstr(r->signature, "int")) return false;
    const py::object what = sentence(self, arguments, keywords, true);
    if (py::len(what) == 0) return false;
    PyErr_SetObject(PyExc_TypeError, what.ptr());
    return true;
}

/// Calls a function. When no overload takes the arguments, the TypeError is one sentence.
PyObject* call(PyObject* self, PyObject* arguments, PyObject* keywords) {
    try {
        if (refused(self, arguments, keywords)) return nullptr;
        PyObject* out = dispatcher(self, arguments, keywords);
        if (out || !PyErr_ExceptionMatches(PyExc_TypeError)) return out;
        py::error_already_set raised;
        const std::string text = py::str(raised.value());
        const Record* r = record_in(self);
        if (!text.starts_with(std::string(r->name) + "(): incompatible "))
            return raised.restore(), nullptr;  // of what the function has called
        PyErr_SetObject(PyExc_TypeError, sentence(self, arguments, keywords, false).ptr());
    } catch (py::error_already_set& e) {
        e.restore();
    }
    return nullptr;
}

void complete(const py::handle& function) {
    if (!PyCFunction_Check(function.ptr())) return;
    const Record* r = record_of(function.ptr());
    PyMethodDef* method = reinterpret_cast<PyCFunctionObject*>(function.ptr())->m_ml;
    if (!r || method->ml_flags != (METH_VARARGS | METH_KEYWORDS)) return;
    const auto meth =
        reinterpret_cast<PyCFunctionWithKeywords>(reinterpret_cast<void (*)()>(method->ml_meth));
    if (meth == &call) return;
    dispatcher = meth;
    method->ml_meth = reinterpret_cast<PyCFunction>(reinterpret_cast<void (*)()>(&call));
    const char* doc = method->ml_doc ? method->ml_doc : "";
    const std::string text = fmt::format("{}{}\n--\n\n{}", method->ml_name, signature(*r), doc);
    std::free(const_cast<char*>(method->ml_doc));  // NOLINT: pybind11 allocates and frees it like this
    method->ml_doc = strdup(text.c_str());
}

int refuse_to_construct(PyObject* self, PyObject*, PyObject*) {
    PyErr_Format(PyExc_TypeError, "%s() cannot be called: other functions of Forage return its objects",
                 py::type::of(self).attr("__name__").cast<std::string>().c_str());
    return -1;
}

/// inspect.signature() of a class without a constructor finds no arguments, where it fails without this text.
void complete_class(const py::handle& type) {
    if (PyInstanceMethod_Check(py::object(type.attr("__dict__")["__init__"]).ptr())) return;
    auto* c = reinterpret_cast<PyTypeObject*>(type.ptr());
    const auto text = fmt::format("{}()\n--\n\n", type.attr("__name__").cast<std::string>());
    // pybind11 allocates it, and Python frees it, by other functions since Python 3.13.
#if PY_VERSION_HEX < 0x030D0000
    constexpr auto allocate = PyObject_Malloc;
    constexpr auto release = PyObject_Free;
#else
    constexpr auto allocate = PyMem_Malloc;
    constexpr auto release = PyMem_Free;
#endif
    auto* copy = static_cast<char*>(allocate(text.size() + 1));
    if (!copy) throw std::bad_alloc();
    std::memcpy(copy, text.c_str(), text.size() + 1);
    release(const_cast<char*>(std::exchange(c->tp_doc, copy)));
    c->tp_init = refuse_to_construct;
}

void complete_members(const py::handle& scope) {
    for (const auto& [name, member] : py::dict(scope.attr("__dict__"))) {
        if (PyInstanceMethod_Check(member.ptr())) {
            complete(PyInstanceMethod_GET_FUNCTION(member.ptr()));
        } else if (PyType_Check(member.ptr())) {
            if (py::object(member.attr("__module__")).equal(py::str("forage._forage")))
                complete_members(member), complete_class(member);
        } else if (py::isinstance(member, reinterpret_cast<PyObject*>(&PyProperty_Type))) {
            complete(member.attr("fget")), complete(member.attr("fset"));
        } else if (py::hasattr(member, "__func__")) {
            complete(member.attr("__func__"));
        } else {
            complete(member);
        }
    }
}

}  // namespace

void complete_functions(py::module_& module) { complete_members(module); }

}  // namespace forage::python
