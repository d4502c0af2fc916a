#include "tools/python/tables.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include "tools/api/open/moves.h"
#include "tools/python/values.h"

namespace forage::python {
namespace {

using namespace py::literals;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

py::object or_nan(const std::optional<double>& value) { return py::float_(value.value_or(nan)); }

/// A structured array of rows, which are tuples; `fields` are pairs of a name and a type.
py::array structured(const py::object& rows, const py::list& fields) {
    return py::module_::import("numpy").attr("array")(rows, "dtype"_a = fields);
}

/// The fields of a trial and their types in NumPy; U: a text.
constexpr std::pair<const char*, const char*> trial_fields[] = {
    {"trial", "i8"},         {"start_x", "f8"},         {"start_y", "f8"},
    {"start_yaw", "f8"},     {"cycles", "i8"},          {"smallest_distance", "f8"},
    {"reached_target", "?"}, {"first_cycle", "i8"},     {"end_x", "f8"},
    {"end_y", "f8"},         {"end_yaw", "f8"},         {"start", "i8"},
    {"patches", "U"},        {"recent_success", "f8"},  {"discrepancy", "f8"},
    {"cue_peak", "f8"},      {"distractor_peak", "f8"}, {"sequences", "i8"},
    {"segments", "i8"}};

/// Its values; -1 and NaN where there are none.
py::tuple row_of(const MeasuredTrials& all, std::size_t i) {
    const auto& t = all.finished[i];
    const auto& m = t.measures;
    const auto peaks = m.peaks();
    const auto filled = [&](auto part) { return m.memory ? static_cast<long>(m.memory.value().*part) : -1; };
    return py::make_tuple(t.number, t.start.x, t.start.y, t.start.yaw, t.cycles, t.smallest_distance,
                          t.reached_target, t.first_cycle, t.end.x, t.end.y, t.end.yaw, m.start, t.route,
                          all.recent_success(i + 1), or_nan(m.discrepancy), peaks ? peaks->cue : nan,
                          peaks ? peaks->distractor : nan, filled(&MemoryFill::sequences),
                          filled(&MemoryFill::segments));
}

}  // namespace

py::object Parameters::get(const std::string& name) const { return value_of(run->use().parameter(name)); }

void Parameters::set(const std::string& name, const py::object& value) const {
    Diagnostics warnings;
    const std::string assignment = fmt::format("{}={}", name, text_of(value));
    run->use().check(assignment, &warnings);
    warn(warnings);  // which may be raised: nothing is set then
    run->use().set(assignment);
}

std::vector<std::string> Parameters::names() const {
    const Run& used = run->use();
    return model::parameter_names(used.system(), used.registry());
}

py::array trials(PythonRun& run, std::size_t robot) {
    const MeasuredTrials all = run.use().trials(robot);
    std::size_t longest = 1;
    for (const auto& t : all.finished) longest = std::max(longest, t.route.size());
    py::list fields, rows;
    for (const auto& [name, type] : trial_fields)
        fields.append(py::make_tuple(name, *type == 'U' ? fmt::format("U{}", longest) : type));
    for (std::size_t i = 0; i < all.finished.size(); ++i)
        rows.append(row_of(all, i) + py::make_tuple(truncated(run.use(), all.finished[i])));
    fields.append(py::make_tuple("truncated", "?"));
    return structured(rows, fields);
}

model::Measure measure_of(const std::string& name, const py::dict& kind, Diagnostics& diagnostics) {
    model::Measure m;
    m.name = name;
    int kinds = 0;
    for (const auto& [key, value] : kind) {
        const auto text = key.cast<std::string>();
        if (text == "of") {
            m.of = {value.cast<std::string>()};
            continue;
        }
        const auto* const at = std::ranges::find(model::measure_kinds, std::string_view(text));
        if (at == model::measure_kinds.end())
            diagnostics.error({}, fmt::format("measure '{}': '{}' is not a kind of measure", name, text),
                              suggest(text, std::vector<std::string>(model::measure_kinds.begin(),
                                                                     model::measure_kinds.end())));
        m.kind = static_cast<model::Measure::Kind>(at - model::measure_kinds.begin());
        m.what = {value.cast<std::string>()}, ++kinds;
    }
    if (kinds != 1 && !diagnostics.failed())
        diagnostics.error({}, fmt::format("measure '{}': name one kind of measure, not {}", name, kinds),
                          "for example first='max(Bug/Light) > 0.5'");
    if (!diagnostics.failed()) model::read_trials(m, diagnostics);
    return m;
}

model::Adaptation adaptation_of(const std::string& kind, const py::dict& options, Diagnostics& diagnostics) {
    const bool halving = kind == "halving";
    const std::vector<std::string> names =
        halving ? std::vector<std::string>{"measure", "keep"}
                : std::vector<std::string>{"measure", "width", "relative_width", "most"};
    model::Adaptation out;
    out.kind = halving ? model::Adaptation::Kind::halving : model::Adaptation::Kind::confidence;
    for (const auto& [key, value] : options) {
        const auto name = key.cast<std::string>();
        if (std::ranges::find(names, name) == names.end())
            diagnostics.error({}, fmt::format("{}: there is no '{}'", kind, name), suggest(name, names));
        if (name == "measure") out.measure = {value.cast<std::string>()};
        if (name == "width") out.width = value.cast<double>();
        if (name == "relative_width") out.relative_width = value.cast<double>();
        if (name == "most") out.most = value.cast<std::uint64_t>();
        if (name == "keep") {
            const auto keep = value.cast<std::string>();
            if (keep != "highest" && keep != "lowest")
                diagnostics.error({}, fmt::format("halving: keep = '{}' is not possible", keep),
                                  "'highest' or 'lowest'");
            out.lowest = keep == "lowest";
        }
    }
    if (out.measure.empty())
        diagnostics.error({}, kind + ": no measure is named", "for example {'measure': 'success', ...}");
    return out;
}

void add_measure(PythonRun& run, const std::string& name, const py::kwargs& kind) {
    Run& r = run.use();
    Diagnostics diagnostics;
    const model::Measure m = measure_of(name, kind, diagnostics);
    for (const auto& o : r.observers())
        if (const auto* others = dynamic_cast<const RunMeasures*>(o.get()))
            for (const auto& other : others->specs())
                if (other.name == name)
                    diagnostics.error({}, fmt::format("there is a measure '{}' already", name));
    throw_errors(diagnostics);
    auto measures = std::make_unique<RunMeasures>(std::span(&m, 1), r.layout(), r.environment(), diagnostics);
    throw_errors(diagnostics);
    measures->check(r.simulation(), diagnostics);
    warn(diagnostics);
    r.add(std::move(measures));
}

py::array measures(PythonRun& run) {
    Run& r = run.use();
    py::list fields, row;
    for (const auto& o : r.observers())
        if (auto* measures = dynamic_cast<RunMeasures*>(o.get())) {
            for (const auto& m : measures->specs()) fields.append(py::make_tuple(m.name, "f8"));
            for (const auto& value : r.measure(*measures)) row.append(or_nan(value));
        }
    return structured(py::tuple(row), fields);
}

void add_parameters(py::module_& module) {
    py::class_<Parameters> type(module, "Parameters",
                                R"(The parameters of a run: run.params["Process/Group.threshold"].

Names are those of `forage run --set`: "Process/Group.parameter", "Process.parameter" of a module, "Connection.parameter" of a synapse. A value is a
bool, int, float or str. Setting one acts from the next cycle on; it raises InputError for unknown names, values that the type refuses, and parameters
that are read at the start only, and warns of values outside the usual range.)");
    type.def(
        "__delitem__",
        [](const Parameters&, const std::string& name) {
            throw py::type_error(
                fmt::format("'{}' cannot be deleted: a type has all of its parameters", name));
        },
        py::arg("name"));
    add_mapping(type);
    type.def("__repr__", [](const Parameters& self) {
        if (const auto why = self.run->obstacle(); !why.empty())
            return fmt::format("<forage.Parameters of a run that is {}>", why);
        return fmt::format("<forage.Parameters, {}>", self.names().size());
    });
}

}  // namespace forage::python
