#include "tools/python/values.h"

#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/run/argument_checks.h"

namespace forage::python {
namespace {

std::string shape_text(const std::vector<py::ssize_t>& shape) {
    return shape.size() == 1 ? fmt::format("({},)", shape[0]) : fmt::format("({})", fmt::join(shape, ", "));
}

}  // namespace

std::string class_name(const py::handle& value) {
    return py::type::handle_of(value).attr("__name__").cast<std::string>();
}

bool is_integer(const py::handle& value) {
    if (!PyIndex_Check(value.ptr())) return false;
    const auto index = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
    if (!index) PyErr_Clear();
    return static_cast<bool>(index);
}

std::optional<std::uint64_t> count_of(const char* name, std::optional<std::int64_t> count) {
    if (count && *count < 0) throw InputError(fmt::format("{}: {} is less than 0", name, *count));
    return count;
}

std::vector<std::string> texts_of(const std::vector<std::filesystem::path>& paths) {
    return {paths.begin(), paths.end()};
}

std::string text_of(const py::handle& value) {
    if (py::isinstance<py::bool_>(value)) return value.cast<bool>() ? "true" : "false";
    return py::str(value);
}

std::string type_name(const py::object& type) {
    return argument<std::string>(py::getattr(type, "type_name", type), "type",
                                 "the name of a type, or a class that is one");
}

py::object value_of(const ParameterValue& value) {
    return std::visit([](const auto& v) -> py::object { return py::cast(v); }, value);
}

std::vector<std::string> assignments(const py::object& settings) {
    std::vector<std::string> out;
    if (py::isinstance<py::dict>(settings))
        for (const auto& [name, value] : settings.cast<py::dict>())
            out.push_back(fmt::format("{}={}", name.cast<std::string>(), text_of(value)));
    else if (!settings.is_none())
        for (const auto& text : settings) out.push_back(text.cast<std::string>());
    return out;
}

std::vector<py::ssize_t> shape_of(const GroupShape& g) {
    if (g.cells != g.width * g.height) return {g.cells};
    return {g.height, g.width};
}

std::vector<py::ssize_t> shape_of(const observe::Recorded& what) {
    if (what.one_number()) return {};
    if (what.numbered) return {static_cast<py::ssize_t>(what.size())};
    return {what.cells.height, what.cells.width};
}

py::array array_of(std::vector<double> values, const std::vector<py::ssize_t>& shape) {
    const double* numbers = values.data();
    return py::array_t<double>(shape, numbers, keeper(std::move(values)));
}

py::array_t<double, py::array::c_style | py::array::forcecast> numeric_array(const py::object& values,
                                                                             const std::string& what) {
    const auto array = py::array::ensure(values);
    if (!array || std::string_view("biuf").find(array.dtype().kind()) == std::string_view::npos)
        throw InputError(fmt::format("{}: a number or an array of numbers is needed, not a value of type {}",
                                     what, class_name(values)));
    return {array};
}

std::vector<double> numbers_of(const py::object& values, const GroupShape& group, const std::string& what) {
    const auto array = numeric_array(values, what);
    check_finite({array.data(), static_cast<std::size_t>(array.size())}, what);
    const auto cells = static_cast<std::size_t>(group.cells);
    if (array.ndim() == 0) return std::vector<double>(cells, *array.data());
    const std::vector<py::ssize_t> given(array.shape(), array.shape() + array.ndim()),
        wanted = shape_of(group);
    if (given != wanted)
        throw InputError(fmt::format("{}: the values have the shape {}, not {}", what, shape_text(given),
                                     shape_text(wanted)),
                         "give one number for all cells, or an array of that shape");
    return {array.data(), array.data() + cells};
}

}  // namespace forage::python
