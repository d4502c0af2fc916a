// Arrays for other packages, by the protocol DLPack.
#pragma once

#include "tools/python/python.h"

namespace forage::python {

/// A capsule of DLPack with the numbers of a contiguous array of 64-bit numbers, which stays in memory as
/// long as the capsule. A read-only array needs a `max_version` of (1, 0) or later: raises BufferError
/// otherwise, because older versions cannot say that it may not be written. `copied`: whether the array is a
/// copy for the consumer.
py::object dlpack(const py::array& numbers, const py::object& max_version, bool copied);

/// Gives a class __dlpack__ and __dlpack_device__; `numbers` returns the array of an object.
template <class Class, class Numbers>
void add_dlpack(Class& type, Numbers numbers) {
    using Self = typename Class::type;
    type.def(
            "__dlpack__",
            [numbers](const Self& self, const py::object&, const py::object& max_version, const py::object&,
                      const py::object& copy) {
                const py::array live = numbers(self);
                const bool copied = !copy.is_none() && copy.cast<bool>();
                return dlpack(copied ? py::array(live.attr("copy")()) : live, max_version, copied);
            },
            py::kw_only(), py::arg("stream") = py::none(), py::arg("max_version") = py::none(),
            py::arg("dl_device") = py::none(), py::arg("copy") = py::none(),
            "The numbers as a capsule of DLPack, for numpy.from_dlpack(group) of NumPy 2. It is live and "
            "read-only, or a copy with copy=True. Raises BufferError for packages that take no read-only "
            "numbers, such as PyTorch 2.6, as arrays of NumPy do.")
        .def(
            "__dlpack_device__", [](const Self&) { return py::make_tuple(1, 0); },
            "The main memory: (1, 0).");
}

}  // namespace forage::python
