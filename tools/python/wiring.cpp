#include "tools/python/wiring.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include "tools/python/values.h"

namespace forage::python {
namespace {

using namespace py::literals;

constexpr const char* directions[] = {"receptive", "projective", nullptr};
/// The constructors, in the order of the variants of the model.
constexpr const char* patterns[] = {"mapped", "foreach", "tuples", "weights"};
constexpr const char* shapes[] = {"rect", "ellipse", "rect_window", "ellipse_window", "all", "random"};
constexpr const char* functions[] = {"uniform", "linear", "gaussian", "block", "random"};

/// Python's text of a value.
std::string repr_of(const py::handle& value) { return py::repr(value).cast<std::string>(); }

/// Some cells of a group: None for all, (x, y, width, height) for a rectangle, or a list of (x, y).
model::Population population(const py::object& cells) {
    constexpr const char* expected = "None, (x, y, width, height) or a list of (x, y)";
    if (cells.is_none()) return model::All();
    if (py::isinstance<py::tuple>(cells) && py::len(cells) == 4) {
        const auto [x, y, width, height] =
            argument<std::tuple<int, int, int, int>>(cells, "a part of a group", expected);
        return model::Region{x, y, width, height, {}};
    }
    return model::List{points_of(argument<py::iterable>(cells, "a part of a group", expected)), {}};
}

py::object value(const model::Population& population) {
    if (const auto* r = std::get_if<model::Region>(&population))
        return py::make_tuple(r->x, r->y, r->width, r->height);
    if (const auto* l = std::get_if<model::List>(&population)) return list_of(l->points);
    return py::none();
}

PythonPattern mapped(const py::object& source, const py::object& target, bool all) {
    return {model::MappedPattern{all, population(source), population(target), true}};
}
PythonPattern foreach (const py::object& source, const py::object& target) {
    return {model::ForeachPattern{population(source), population(target)}};
}
PythonPattern tuples(const std::vector<std::pair<py::iterable, py::iterable>>& pairs) {
    model::TuplesPattern out;
    for (const auto& [sources, targets] : pairs)
        out.tuples.push_back({points_of(sources), points_of(targets)});
    return {std::move(out)};
}

/// The rows source, target, weight of a sparse matrix of SciPy.
py::object rows_of(const py::object& matrix) {
    const py::object sparse = matrix.attr("tocoo")();
    return py::module_::import("numpy").attr("column_stack")(
        py::make_tuple(sparse.attr("col"), sparse.attr("row"), sparse.attr("data")));
}

}  // namespace

/// A table of numbers as the text of a file; a text is the name of a file.
PythonPattern pattern_of_weights(const py::object& numbers, bool list) {
    if (py::hasattr(numbers, "tocoo")) return pattern_of_weights(rows_of(numbers), true);
    model::Weights out;
    out.is_list = list;
    if (py::isinstance<py::str>(numbers) || py::hasattr(numbers, "__fspath__")) {
        out.file = py::module_::import("os").attr("fspath")(numbers).cast<std::string>();
        return {std::move(out)};
    }
    constexpr py::ssize_t max_numbers = 1'000'000;
    const auto array = argument<py::array_t<double, py::array::c_style | py::array::forcecast>>(
        numbers, "weights", "the name of a file or an array of numbers");
    if (array.ndim() != 2) throw InputError("weights: the array needs two dimensions", "targets x sources");
    if (array.size() > max_numbers)
        throw InputError(
            fmt::format("weights: {} numbers are too many for the text of a system", array.size()),
            "numpy.save('w.npy', weights) and give the name of the file");
    for (py::ssize_t row = 0; row < array.shape(0); ++row) {
        for (py::ssize_t i = 0; i < array.shape(1); ++i)
            out.text += fmt::format("{}{}", i > 0 ? " " : "", array.at(row, i));
        out.text += '\n';
    }
    return {std::move(out)};
}

namespace {

/// The cells at one end of a pattern; a list per tuple of a pattern of tuples.
py::object cells(const model::Pattern& pattern, bool source) {
    if (const auto* tuples = std::get_if<model::TuplesPattern>(&pattern)) {
        py::list out;
        for (const auto& t : tuples->tuples) out.append(list_of(source ? t.sources : t.targets));
        return out;
    }
    return std::visit(
        [&](const auto& p) -> py::object {
            if constexpr (requires { p.source; }) return value(source ? p.source : p.target);
            return py::none();
        },
        pattern);
}

std::string repr(const PythonPattern& self) {
    const model::Pattern& pattern = self.value;
    std::vector<std::string> arguments;
    if (std::holds_alternative<model::TuplesPattern>(pattern)) {
        const py::object zipped =
            py::module_::import("builtins").attr("zip")(cells(pattern, true), cells(pattern, false));
        arguments.push_back(repr_of(py::list(zipped)));
    } else if (const auto* w = std::get_if<model::Weights>(&pattern)) {
        arguments.push_back(repr_of(py::str(w->file.empty() ? w->text : w->file)));
        if (w->is_list) arguments.emplace_back("list=True");
    } else {
        const auto source = cells(pattern, true), target = cells(pattern, false);
        if (!source.is_none() || !target.is_none()) arguments = {repr_of(source), repr_of(target)};
        const auto* mapped = std::get_if<model::MappedPattern>(&pattern);
        if (mapped && mapped->all) arguments.emplace_back("all=True");
    }
    return fmt::format("forage.Pattern.{}({})", patterns[pattern.index()], fmt::join(arguments, ", "));
}

template <class Shape>
model::Arborization arborization(Shape shape, const std::string& direction, double probability) {
    return {
        shape, static_cast<model::Direction>(choice(direction, directions, "direction")), probability, {}};
}
template <class Shape>
model::Arborization rectangle(int width, int height, const std::string& direction, double probability) {
    return arborization(Shape{width, height}, direction, probability);
}
template <class Shape>
model::Arborization window(std::pair<int, int> inner, std::pair<int, int> outer, const std::string& direction,
                           double probability) {
    return arborization(Shape{inner.first, inner.second, outer.first, outer.second}, direction, probability);
}

/// The arguments of a constructor.
template <class Rectangle>
std::string arguments(const Rectangle& s) {
    return fmt::format("{}, {}", s.width, s.height);
}
template <class Window>
requires requires(Window s) { s.inner_width; }
std::string arguments(const Window& s) {
    return fmt::format("({}, {}), ({}, {})", s.inner_width, s.inner_height, s.outer_width, s.outer_height);
}
std::string arguments(const model::AllArbor&) { return {}; }
std::string arguments(const model::RandomArbor& s) { return fmt::format("{}", s.count); }
std::string arguments(const model::UniformFunction& f) { return fmt::format("{}", f.value); }
std::string arguments(const model::LinearFunction& f) { return fmt::format("{}, {}", f.min, f.max); }
std::string arguments(const model::GaussianFunction& f) {
    return fmt::format("{}, {}, {}", f.min, f.max, f.sigma);
}
std::string arguments(const model::BlockFunction& f) {
    return fmt::format("{}, {}, {}, {}", f.min, f.max, f.width, f.height);
}
std::string arguments(const model::RandomFunction& f) { return fmt::format("{}", f.max); }

template <class Variant>
std::string arguments_of(const Variant& variant) {
    return std::visit([](const auto& form) { return arguments(form); }, variant);
}

std::string repr(const model::Arborization& a) {
    std::string text = arguments_of(a.shape);
    const auto add = [&](const std::string& more) { text += (text.empty() ? "" : ", ") + more; };
    if (a.direction == model::Direction::projective) add("direction='projective'");
    if (a.probability != 1) add(fmt::format("probability={}", a.probability));
    return fmt::format("forage.Arborization.{}({})", shapes[a.shape.index()], text);
}

std::string repr(const model::DistanceFunction& f) {
    return fmt::format("forage.DistanceFunction.{}({})", functions[f.form.index()], arguments_of(f.form));
}

/// What pickles keep of a value: the call that its text shows.
template <class T>
py::tuple reduced(const T& self) {
    return py::make_tuple(py::module_::import("forage._state").attr("value"), py::make_tuple(repr(self)));
}
py::tuple reduced(const PythonPattern& self) {
    const auto* w = std::get_if<model::Weights>(&self.value);
    if (!w || !w->file.empty()) return reduced<PythonPattern>(self);
    return py::make_tuple(py::module_::import("forage._state").attr("weights"),
                          py::make_tuple(w->text, w->is_list));
}

/// Values never change and are compared by their content.
template <class T>
void add_value(py::class_<T>& type) {
    type.def(
            "__eq__", [](const T& a, const T& b) { return a == b; }, py::is_operator())
        .def("__repr__", [](const T& self) { return repr(self); })
        .def("__hash__", [](const T& self) { return py::hash(py::str(repr(self))); })
        .def("__reduce__", [](const T& self) { return reduced(self); })
        .def("__copy__", [](const py::object& self) { return self; })
        .def("__deepcopy__", [](const py::object& self, const py::dict&) { return self; });
}

void add_patterns(py::module_& module) {
    const auto all = py::none();
    py::class_<PythonPattern> type(
        module, "Pattern", R"(Which cells of a connection's source are paired with which cells of its target.

Cells are given as None for all of them, (x, y, width, height) for a rectangle with its upper left cell, or a list of (x, y). Cells count from 1.
Patterns never change, and are equal when they say the same.)");
    type.def_static(
            "mapped", &mapped, "source"_a = all, "target"_a = all, py::kw_only(), "all"_a = false,
            R"(Scales the smaller end to the size of the larger one, and pairs cells at the same place.

all: whether a cell is paired with every cell under its projection, not only with the one at its centre.)")
        .def_static("foreach", &foreach, "source"_a = all, "target"_a = all,
                    "Pairs every cell of the source with every cell of the target.")
        .def_static("tuples", &tuples, "pairs"_a,
                    "Pairs each cell of a list with each cell of another: tuples([(sources, targets), ...]).")
        .def_static("weights", &pattern_of_weights, "numbers"_a, py::kw_only(), "list"_a = false,
                    R"(A synapse for each number, which is its weight.

numbers: an array with a row for each cell of the target and a column for each cell of the source, a sparse matrix of SciPy, or the name of a .npy or CSV file, relative to that of the system; nan: no synapse.
list: whether it has rows source, target, weight and perhaps delay instead; cells count from 0, row by row.)")
        .def_property_readonly(
            "kind", [](const PythonPattern& self) { return patterns[self.value.index()]; },
            R"("mapped", "foreach", "tuples" or "weights".)")
        .def_property_readonly(
            "source", [](const PythonPattern& self) { return cells(self.value, true); },
            "The cells of the source in the given order; a list of lists of a pattern of tuples.")
        .def_property_readonly(
            "target", [](const PythonPattern& self) { return cells(self.value, false); },
            "The cells of the target in the given order; a list of lists of a pattern of tuples.");
    add_value(type);
}

void add_arborizations(py::module_& module) {
    py::class_<model::Arborization> type(
        module, "Arborization",
        R"(How each pair of cells spreads into synapses: to the cells of a shape around one of them.

direction: "receptive" spreads around the source cell, "projective" around the target cell.
probability: with which each synapse is kept, 0 to 1.

Arborizations never change, and are equal when they say the same.)");
    const auto add = [&](const char* name, auto make, const char* doc, auto... arguments) {
        type.def_static(name, make, arguments..., py::kw_only(), "direction"_a = "receptive",
                        "probability"_a = 1.0, doc);
    };
    add("rect", &rectangle<model::RectArbor>, "The cells of a rectangle.", "width"_a, "height"_a);
    add("ellipse", &rectangle<model::EllipseArbor>, "The cells of an ellipse.", "width"_a, "height"_a);
    add("rect_window", &window<model::RectWindowArbor>,
        "The cells of the rectangle `outer` that are not in `inner`, both (width, height).", "inner"_a,
        "outer"_a);
    add("ellipse_window", &window<model::EllipseWindowArbor>,
        "The cells of the ellipse `outer` that are not in `inner`, both (width, height).", "inner"_a,
        "outer"_a);
    add(
        "all", [](const std::string& d, double p) { return arborization(model::AllArbor(), d, p); },
        "Every cell of the group.");
    add(
        "random",
        [](int count, const std::string& d, double p) {
            return arborization(model::RandomArbor{count}, d, p);
        },
        "This many distinct cells of the group, drawn for each pair.", "count"_a);
    type.def_property_readonly(
            "kind", [](const model::Arborization& self) { return shapes[self.shape.index()]; },
            "The name of the function that made it.")
        .def_property_readonly(
            "direction",
            [](const model::Arborization& self) { return directions[static_cast<int>(self.direction)]; },
            R"("receptive" or "projective".)")
        .def_readonly("probability", &model::Arborization::probability,
                      "The probability with which each synapse is kept.");
    add_value(type);
}

template <class Form, class... Arguments>
model::DistanceFunction function(Arguments... arguments) {
    return {Form{arguments...}, {}};
}

void add_functions(py::module_& module) {
    py::class_<model::DistanceFunction> type(
        module, "DistanceFunction",
        R"(How an attenuation or a delay (in cycles) depends on the distance d of two cells, in cells. docs/reference/system-file.md explains the forms.

A number does for the same value everywhere. Functions never change, and are equal when they say the same.)");
    type.def_static("uniform", &function<model::UniformFunction, double>, "value"_a, "The same everywhere.")
        .def_static(
            "linear", &function<model::LinearFunction, double, double>, "min"_a, "max"_a,
            "min + (max - min) d / D at the distance d, where D is the largest one in the connection.")
        .def_static("gaussian", &function<model::GaussianFunction, double, double, double>, "min"_a, "max"_a,
                    "sigma"_a, "max - (max - min) exp(-d^2 / (2 sigma^2)) + min at the distance d.")
        .def_static("block", &function<model::BlockFunction, double, double, int, int>, "min"_a, "max"_a,
                    "width"_a, "height"_a = 0,
                    "min up to a distance of width / 2, then max. The height has no effect.")
        .def_static("random", &function<model::RandomFunction, double>, "max"_a,
                    "A random number from 0 to max for each synapse.")
        .def_property_readonly(
            "kind", [](const model::DistanceFunction& self) { return functions[self.form.index()]; },
            "The name of the function that made it.");
    add_value(type);
}

}  // namespace

int choice(const std::string& name, const char* const* values, const char* what) {
    std::vector<std::string> known;
    for (int i = 0; values[i]; ++i) {
        if (name == values[i]) return i;
        known.emplace_back(values[i]);
    }
    throw InputError(fmt::format("{} = '{}' is not '{}'", what, name, fmt::join(known, "' or '")),
                     suggest(name, known));
}

std::vector<model::Point> points_of(const py::iterable& points) {
    std::vector<model::Point> out;
    for (const auto& p : points) {
        const auto [x, y] = argument<std::pair<int, int>>(p, "a cell", "(x, y)");
        out.push_back({x, y, {}});
    }
    return out;
}

py::list list_of(const std::vector<model::Point>& points) {
    py::list out;
    for (const auto& p : points) out.append(py::make_tuple(p.x, p.y));
    return out;
}

model::DistanceFunction function_of(const py::object& value) {
    if (py::isinstance<model::DistanceFunction>(value)) return value.cast<model::DistanceFunction>();
    return {model::UniformFunction{
                argument<double>(value, "a function of the distance", "a number or a DistanceFunction")},
            {}};
}

void add_wiring(py::module_& module) {
    add_patterns(module);
    module.def("_weights_of_text", [](const std::string& text, bool list) {
        model::Weights out;
        out.text = text, out.is_list = list;
        return PythonPattern{std::move(out)};
    });
    add_arborizations(module);
    add_functions(module);
}

}  // namespace forage::python
