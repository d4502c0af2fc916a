#include "tools/python/dlpack.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace forage::python {
namespace {

// The structures of DLPack 1.0 (https://dmlc.github.io/dlpack/latest/c_api.html), whose header Debian does
// not have.
struct DLTensor {
    void* data;
    std::int32_t device_type, device_id;
    std::int32_t ndim;
    std::uint8_t code, bits;
    std::uint16_t lanes;
    std::int64_t* shape;
    std::int64_t* strides;
    std::uint64_t byte_offset;
};
struct Managed {  // before version 1
    DLTensor tensor;
    void* context;
    void (*deleter)(Managed*);
};
struct Versioned {
    std::uint32_t major, minor;
    void* context;
    void (*deleter)(Versioned*);
    std::uint64_t flags;
    DLTensor tensor;
};
constexpr std::uint64_t flag_read_only = 1, flag_is_copied = 2;

/// A capsule's structure, the array that it shows, and its shape.
template <class Structure>
struct Export {
    Structure managed{};
    py::object array;
    std::vector<std::int64_t> shape, strides;

    static void free(Structure* s) {
        const py::gil_scoped_acquire python;
        delete static_cast<Export*>(s->context);
    }
};

template <class Structure, class Complete>
py::object capsule(const py::array& numbers, const char* name, Complete complete) {
    auto made = std::make_unique<Export<Structure>>();
    made->array = numbers;
    made->shape.assign(numbers.shape(), numbers.shape() + numbers.ndim());
    made->strides.resize(made->shape.size());
    for (std::int64_t i = numbers.ndim() - 1, step = 1; i >= 0; --i) {
        made->strides[static_cast<std::size_t>(i)] = step;
        step *= made->shape[static_cast<std::size_t>(i)];
    }
    Structure& s = made->managed;
    s.context = made.get(), s.deleter = &Export<Structure>::free;
    s.tensor = {const_cast<void*>(numbers.data()),
                1,
                0,
                static_cast<std::int32_t>(numbers.ndim()),
                2,
                64,
                1,
                made->shape.data(),
                made->strides.data(),
                0};
    complete(s);
    // A consumer renames the capsule and frees the structure itself.
    PyObject* out = PyCapsule_New(&s, name, [](PyObject* c) {
        const char* now = PyCapsule_GetName(c);
        if (!now || std::string_view(now).starts_with("used_")) return;
        auto* unused = static_cast<Structure*>(PyCapsule_GetPointer(c, now));
        unused->deleter(unused);
    });
    if (!out) throw py::error_already_set();
    made.release();  // NOLINT(bugprone-unused-return-value): the capsule owns it
    return py::reinterpret_steal<py::object>(out);
}

}  // namespace

py::object dlpack(const py::array& numbers, const py::object& max_version, bool copied) {
    if (!max_version.is_none() && max_version.cast<std::pair<int, int>>().first >= 1)
        return capsule<Versioned>(numbers, "dltensor_versioned", [&](Versioned& v) {
            v.major = 1;
            v.flags = (numbers.writeable() ? 0 : flag_read_only) | (copied ? flag_is_copied : 0);
        });
    if (!numbers.writeable())
        throw py::buffer_error(
            "the numbers are read-only, which this version of DLPack cannot say: take a copy, "
            "numpy.array(...)");
    return capsule<Managed>(numbers, "dltensor", [](Managed&) {});
}

}  // namespace forage::python
